#include "stages/gel/press/world/press_config.h"

#include "common/sample/body_keys.h"

namespace tacipc {

FrictionConfig FrictionConfig::read(ConfigReader& in) {
  FrictionConfig config;
  config.coefficient = in.number("coefficient", coefficients());
  config.relative_speed_threshold =
      in.number_or("relative_speed_threshold", 1e-3, {.low = 0.0, .high = 1.0, .open_low = true});
  const std::string lag = in.choice_or("lag", "once", {"once", "iterated", "iterated_at_minima"});
  config.iterated = lag != "once";
  config.only_at_minima = lag == "iterated_at_minima";
  config.max_lag_iterations = in.integer_or("max_lag_iterations", 50, 1);
  config.relative_lag_tolerance = in.number_or("relative_lag_tolerance", 1e-2, Range::positive());
  return config;
}

PressConfig PressConfig::read(ConfigReader& in) {
  PressConfig config;
  config.time_step_s = in.number("time_step_s", Range::positive());
  config.quasi_static =
      in.choice_or("dynamics", "implicit_euler", {"implicit_euler", "quasi_static"}) == "quasi_static";
  config.gravity_m_s2 = read_triple(in, "gravity_m_s2", 1.0);
  if (auto damping = in.optional_section("damping")) {
    config.mass_damping_per_s = damping->number_or("mass_per_s", 0.0, Range::non_negative());
    config.stiffness_damping_s = damping->number_or("stiffness_s", 0.0, Range::non_negative());
  }
  config.element = in.choice_or("element", "auto", {"auto", "linear", "averaged_volume"});
  config.augmented_lagrangian =
      in.choice_or("constraints", "elimination", {"elimination", "augmented_lagrangian"}) == "augmented_lagrangian";
  ConfigReader barrier = in.section("barrier");
  config.relative_d_hat = barrier.number("relative_d_hat", {.low = 0.0, .high = 0.1, .open_low = true});
  if (barrier.has("relative_stiffness")) {
    config.relative_barrier_stiffness = barrier.number("relative_stiffness", Range::positive());
    if (barrier.has("stiffness")) {
      barrier.fault("stiffness", "give stiffness or relative_stiffness, not both");
      barrier.ignore("stiffness");
    }
  } else if (barrier.has("stiffness")) {
    config.barrier_stiffness = barrier.number("stiffness", Range::positive());
  }
  const bool given = barrier.has("stiffness") || barrier.has("relative_stiffness");
  config.adaptive_barrier_stiffness = barrier.flag_or("adaptive", !given);
  config.pair_counting.once = barrier.choice_or("pairs", "every", {"every", "once"}) == "once";
  if (config.pair_counting.once)
    config.pair_counting.edge_weight =
        barrier.number_or("edge_weight", config.pair_counting.edge_weight, {.low = 0.0, .high = 1.0, .open_low = true});
  config.start_gap_d_hat = barrier.number_or("start_gap_d_hat", 1.2, {.low = 1.0, .high = 100.0, .open_low = true});
  if (auto friction = in.optional_section("friction")) config.friction = FrictionConfig::read(*friction);
  ConfigReader newton = in.section("newton");
  config.relative_velocity_tolerance = newton.number_or("relative_velocity_tolerance", 1e-3, Range::positive());
  config.newton.relative_force_tolerance = newton.number_or("relative_force_tolerance", 5e-4, Range::positive());
  config.newton.force_tolerance_n = newton.number_or("force_tolerance_n", 1e-5, Range::positive());
  config.linear_solver =
      newton.choice_or("linear_solver", "conjugate_gradient", {"direct", "conjugate_gradient"}) == "direct"
          ? LinearSolverKind::direct
          : LinearSolverKind::conjugate_gradient;
  config.newton.adaptive_contact_hessian =
      newton.choice_or("contact_hessian", "adaptive", {"adaptive", "positive"}) == "adaptive";
  config.newton.patches = newton.flag_or("patches", true);
  config.newton.max_iterations = newton.integer_or("max_iterations", 200, 1);
  config.max_halvings = newton.integer_or("max_halvings", 5, 0, 20);
  config.stress = in.flag_or("stress", false);
  if (config.stress && config.stiffness_damping_s > 0.0)
    in.fault("stress", "is not measured with damping.stiffness_s, a damping of elements that has no stress of its own");
  return config;
}

bool PressConfig::takes_friction_of(const Sensor& sensor) const {
  return sensor.friction && coefficient_of_friction() > 0.0;
}

PressConfig PressConfig::with_friction_of(const Sensor& sensor) const {
  PressConfig with = *this;
  if (takes_friction_of(sensor)) with.friction->coefficient = *sensor.friction;
  return with;
}

}  // namespace tacipc
