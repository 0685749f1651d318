#include "stages/press/press_config.h"

#include <numbers>

#include "stages/press/placement.h"

namespace tacipc {

PressConfig PressConfig::read(ConfigReader& in) {
  PressConfig config;
  config.time_step_s = in.number("time_step_s", Range::positive());
  ConfigReader barrier = in.section("barrier");
  config.relative_d_hat = barrier.number("relative_d_hat", {.low = 0.0, .high = 0.1, .open_low = true});
  config.barrier_stiffness = barrier.number("stiffness", Range::positive());
  config.start_gap_d_hat = barrier.number_or("start_gap_d_hat", 1.2, {.low = 1.0, .high = 100.0, .open_low = true});
  ConfigReader newton = in.section("newton");
  config.relative_velocity_tolerance = newton.number_or("relative_velocity_tolerance", 1e-3, Range::positive());
  config.relative_force_tolerance = newton.number_or("relative_force_tolerance", 5e-4, Range::positive());
  config.force_tolerance_n = newton.number_or("force_tolerance_n", 1e-5, Range::positive());
  config.max_newton_iterations = newton.integer_or("max_iterations", 500, 1);
  return config;
}

SampleSpec SampleSpec::read(ConfigReader& in) {
  SampleSpec spec;
  if (auto placement = in.optional_section("placement")) {
    if (placement->has("face")) spec.face = placement->choice("face", face_names());
    spec.rotate_rad = placement->number_or("rotate_deg", 0.0) * std::numbers::pi / 180.0;
    const auto center_mm = placement->numbers_or("center_mm", {0.0, 0.0});
    spec.center_x_m = 1e-3 * center_mm[0];
    spec.center_y_m = 1e-3 * center_mm[1];
  }
  ConfigReader motion = in.section("motion");
  motion.choice("kind", {"press"});
  spec.depth_m = 1e-3 * motion.number("depth_mm", Range::positive());
  spec.steps = motion.integer("steps", 1, 100000);
  return spec;
}

}  // namespace tacipc
