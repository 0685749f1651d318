// What a page shows of a grasp beside its two fingers: the outcome, forces over time, and both sensors' images in a
// row.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/base/types.h"
#include "common/image/image.h"

namespace tacipc {

/// One frame of a grasp's record.
struct GraspMoment {
  double time_s = 0.0;
  std::string phase;
  double grip_left_n = 0.0, grip_right_n = 0.0, carried_n = 0.0;
};

struct GraspReport {
  std::string outcome;
  double mass_kg = 0.0, grip_n = 0.0;
  std::optional<double> friction_margin;  // nothing where the object has no weight
  int judged_frame = 0;                   // that the outcome is of, and these:
  double slip_m = 0.0, turn_rad = 0.0;
  Vector3 grip_m = Vector3::Zero();  // from the centre of mass to where it is gripped, in the object's axes
  double lever_m = 0.0;              // of the centre of mass about the line on which the fingers press
  std::optional<double> width_m;     // of a drawn grasp
  std::vector<GraspMoment> moments;
};

/// \throw DataError if the folder has no record of a grasp
GraspReport read_grasp(const std::filesystem::path& folder);

/// Grip and carried force over time, as SVG text.
std::string grasp_plot(const GraspReport& grasp);

/// Images of the left finger above those of the right one, of at most ten frames from the first to the last.
/// \throw DataError if one is not there
ByteImage grasp_strip(const std::filesystem::path& folder, std::size_t frames);

/// A section of the page, which has the plot and the strip beside it under these names.
inline constexpr const char* kGraspPlot = "grasp_forces.svg";
inline constexpr const char* kGraspStrip = "grasp_strip.png";
std::string grasp_section(const GraspReport& grasp);

}  // namespace tacipc
