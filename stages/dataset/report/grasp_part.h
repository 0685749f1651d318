// What a page shows of a grasp beside its fingers: the outcome, forces and slip over time, and the sensors' images in a
// row.
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
  double slip_m = 0.0, turn_rad = 0.0;                   // relative to the hand, since the object was freed
  std::array<std::optional<double>, 2> slip_share = {};  // of the normal force of left and right finger
};

struct GraspReport {
  std::string outcome;
  std::optional<std::string> reason = std::nullopt;  // of any outcome but lifted
  std::array<SlipLines, 2> slips = {};               // of left and right finger
  std::optional<double> friction = std::nullopt;     // coefficient
  std::optional<Vector3> center_shift_m = std::nullopt;
  double mass_kg = 0.0, grip_n = 0.0;
  std::optional<double> friction_margin;                                   // nothing where the object has no weight
  std::size_t judged_frame = 0;                                            // that the outcome is of
  std::optional<double> creep_m = std::nullopt, creep_rad = std::nullopt;  // part of slip and turn in that frame
  Vector3 grip_m = Vector3::Zero();  // from the centre of mass to where it is gripped, in the object's axes
  double lever_m = 0.0;              // of the centre of mass about the line on which the fingers press
  std::optional<double> width_m;     // of a drawn grasp
  std::vector<GraspMoment> moments;
  bool has_view = false;  // in 3-D, beside the page
};

/// \throw DataError if the folder has no record of a grasp
GraspReport read_grasp(const std::filesystem::path& folder);

/// A row of images for each gel, of at most ten frames from the first to the last, with words what they are. `frames`:
/// of the grasp. \throw DataError if an image is not there
ByteImage grasp_strip(const std::vector<SceneGel>& gels, const std::vector<GraspMoment>& frames);
inline constexpr const char* kGraspStrip = "grasp_strip.png";

/// Of one finger: the strip of both, the labels, and curves of forces, of slip and of the share that slips.
/// \param strip source of the strip's picture, HTML; empty: none
std::string grasp_article(const GraspReport& grasp, std::size_t side, const std::string& strip);

/// Id of the section on the page, and of the grasp's view.
inline constexpr const char* kGraspId = "grasp";

/// What the page says of the grasp; the strip lies beside it under its name.
PageWords grasp_words(const GraspReport& grasp);

/// What is said of each frame of a view: "frame 12 of 40 · lift · 0.12 s · grip left 5.01 N, right 4.98 N · carried
/// 0.79 N".
std::vector<std::string> grasp_texts(const GraspReport& grasp, const SceneView& view);

}  // namespace tacipc
