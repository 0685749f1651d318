// What a press needs to be told: numerics that hold for a dataset, and the motion of one sample.
#pragma once

#include <optional>
#include <string>

#include "common/config.h"

namespace tacipc {

/// configs/press/*.yaml
struct PressConfig {
  double time_step_s = 0.0;
  double relative_d_hat = 0.0;     // d̂ as part of the diagonal of the undeformed gel's bounding box
  double barrier_stiffness = 0.0;  // κ of κ B(x) beside h² Φ(x), squared distances: J s² / m⁴ = kg m⁻²
  double start_gap_d_hat = 0.0;    // gap of frame 0 between the object's lowest point and z = 0, in d̂
  double relative_velocity_tolerance = 0.0;  // Newton: max |p| / h below this part of the diagonal per second
  double relative_force_tolerance = 0.0;     // and residual forces below this part of the contact force
  double force_tolerance_n = 0.0;            // or below this
  int max_newton_iterations = 0;             // per step; reaching it is a failure

  static PressConfig read(ConfigReader& in);
};

/// configs/samples/*.yaml: how the object is placed and moved.
struct SampleSpec {
  std::optional<std::string> face;  // side that presses; absent: as the object's YAML says
  double rotate_rad = 0.0;
  double center_x_m = 0.0;
  double center_y_m = 0.0;
  double depth_m = 0.0;  // of the object's lowest point below z = 0 in the last frame
  int steps = 0;

  static SampleSpec read(ConfigReader& in);
};

}  // namespace tacipc
