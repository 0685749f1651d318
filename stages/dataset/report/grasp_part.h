// Shows a grasp on a page in addition to its fingers: outcome, forces and slip over time, and a row of sensor images.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/base/types.h"
#include "common/image/image.h"
#include "common/sample/press_record.h"
#include "stages/dataset/report/page.h"
#include "stages/dataset/report/view/scene_view.h"

namespace tacipc {

/// One frame of a grasp's record.
struct GraspMoment {
  double time_s = 0.0;
  std::string phase;
  double grip_left_n = 0.0, grip_right_n = 0.0, carried_n = 0.0;
  double slip_m = 0.0, turn_rad = 0.0;  // motion relative to the hand since the object was released
  std::array<std::optional<double>, 2> slip_share =
      {};  // slipping fraction of the normal force of left and right finger
};

/// Data of a grasp from its record.
struct GraspReport {
  std::string outcome;
  std::optional<std::string> reason = std::nullopt;  // reason of any outcome except lifted
  std::array<SlipLines, 2> slips = {};               // slip times of left and right finger
  std::optional<double> friction = std::nullopt;     // friction coefficient
  std::optional<Vector3> center_shift_m = std::nullopt;
  double mass_kg = 0.0, grip_n = 0.0;
  std::optional<double> friction_margin;  // absent for an object without weight
  std::size_t judged_frame = 0;           // frame in which the outcome was judged
  std::optional<double> creep_m = std::nullopt,
                        creep_rad = std::nullopt;  // creep as a part of slip and rotation in that frame
  Vector3 grip_m = Vector3::Zero();                // vector from the centre of mass to the grip, in the object's axes
  double lever_m = 0.0;           // distance of the centre of mass from the line along which the fingers press
  std::optional<double> width_m;  // grip width of a drawn grasp
  std::vector<GraspMoment> moments;
  bool has_view = false;  // a 3-D view exists for the page
};

/// Reads a grasp.
/// \throw DataError if the folder has no record of a grasp
GraspReport read_grasp(const std::filesystem::path& folder);

/// Picture with a row of images for each gel, of at most ten frames from the first to the last, with labels. `frames`
/// are the frames of the grasp.
/// \throw DataError if an image is missing
ByteImage grasp_strip(const std::vector<SceneGel>& gels, const std::vector<GraspMoment>& frames);
inline constexpr const char* kGraspStrip = "grasp_strip.png";

/// Article of one finger: the strip of both, the labels, and curves of forces, slip and the slipping fraction.
/// \param strip source of the strip's picture, HTML; empty: no strip
std::string grasp_article(const GraspReport& grasp, std::size_t side, const std::string& strip);

/// Id of the section on the page, and of the grasp's view.
inline constexpr const char* kGraspId = "grasp";

/// Text of the page on the grasp; the strip lies next to it under kGraspStrip.
PageWords grasp_words(const GraspReport& grasp);

/// Caption of each frame of a view, such as "frame 12 of 40 · lift · 0.12 s · grip left 5.01 N, right 4.98 N · carried
/// 0.79 N".
std::vector<std::string> grasp_texts(const GraspReport& grasp, const SceneView& view);

}  // namespace tacipc
