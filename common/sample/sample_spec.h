// The sample file: how an object is placed over the gel and moved.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/config/config.h"
#include "common/sample/motion.h"

namespace tacipc {

/// configs/motions/*.yaml: how the object is placed and moved.
struct SampleSpec {
  std::optional<std::string> face;  // side that presses; absent: as the object's YAML says
  double rotate_rad = 0.0;
  double center_x_m = 0.0;
  double center_y_m = 0.0;
  bool may_miss = false;                // the gel: the object may go beside it and touch nothing
  std::optional<double> density_kg_m3;  // of the object, where a load moves it or it is free
  std::vector<Phase> motion;

  static SampleSpec read(ConfigReader& in);
};

/// A phase that begins with the object at `gel_from_object`, after it was placed at `placed` with its lowest point at
/// height `start_z_m`. No axis is free and nothing loads it.
PhaseStart phase_start(const SampleSpec& sample, const Positions& object_positions, const Matrix4& placed,
                       const Matrix4& gel_from_object, double start_z_m);

/// Last frame of the first press, or none. `phase_of_frame` holds the phase of each frame as an index into the motion,
/// and −1 for frame 0.
std::optional<std::size_t> press_end_frame(const SampleSpec& sample, const std::vector<int>& phase_of_frame);

}  // namespace tacipc
