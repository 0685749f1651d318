// The sample file: placement of an object over the gel, and its motion.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/config/config.h"
#include "common/sample/motion.h"

namespace tacipc {

/// Contents of configs/motions/*.yaml.
struct SampleSpec {
  std::optional<std::string> face;  // side that presses; absent: as for the object's file
  double rotate_rad = 0.0;
  double center_x_m = 0.0;
  double center_y_m = 0.0;
  bool may_miss = false;                // the object may miss the gel and touch nothing
  std::optional<double> density_kg_m3;  // density of the object, if a load moves it or it is free
  std::vector<Phase> motion;

  /// Reads the file.
  static SampleSpec read(ConfigReader& in);
};

/// Returns the start of a phase with the object at `gel_from_object`, without free axes or load.
/// \param placed gel_from_object in frame 0
/// \param start_z_m height of the object's lowest point in frame 0
PhaseStart phase_start(const SampleSpec& sample, const Positions& object_positions, const Matrix4& placed,
                       const Matrix4& gel_from_object, double start_z_m);

/// Returns the last frame of the first press phase; nothing if there is none.
/// \param phase_of_frame index of each frame's phase in the motion; −1 for frame 0
std::optional<std::size_t> press_end_frame(const SampleSpec& sample, const std::vector<int>& phase_of_frame);

}  // namespace tacipc
