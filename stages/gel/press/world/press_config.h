// Settings of the press stage: numerics that hold for a dataset.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/config/config.h"
#include "common/sensor/sensor.h"
#include "stages/gel/press/solve/step_settings.h"

namespace tacipc {

/// Smoothed Coulomb friction between object and gel, and of the gel with itself.
struct FrictionConfig {
  double coefficient = 0.0;               // μ
  double relative_speed_threshold = 0.0;  // ε_v as part of the diagonal per second: slower sliding counts as sticking
  bool iterated = false;                  // normal forces and tangent planes renewed until they fit, else once per step
  bool only_at_minima = false;            // iterated: not before each iteration of Newton's method
  int max_lag_iterations = 0;
  double relative_lag_tolerance = 0.0;  // residual forces after renewing, as part of the contact force

  static FrictionConfig read(ConfigReader& in);
  static Range coefficients() { return {.low = 0.0, .high = 10.0}; }
};

/// configs/press/*.yaml
struct PressConfig {
  double time_step_s = 0.0;
  bool quasi_static = false;  // the gel has no inertia
  Vector3 gravity_m_s2 = Vector3::Zero();
  double mass_damping_per_s = 0.0;          // Rayleigh: damping matrix = this × mass matrix …
  double stiffness_damping_s = 0.0;         // … + this × stiffness matrix
  std::string element;                      // "auto", "linear", "averaged_volume"
  bool augmented_lagrangian = false;        // glued face and object by multipliers, else eliminated
  double relative_d_hat = 0.0;              // d̂ as part of the diagonal of the undeformed gel's bounding box
  std::optional<double> barrier_stiffness;  // κ of κ B(x) beside h² Φ(x), squared distances: J s² / m⁴ = kg m⁻²
  double relative_barrier_stiffness = 0.2;  // if absent: κ d̂³ / (h² E ℓ²), ℓ the median edge of the front
  bool adaptive_barrier_stiffness = false;  // κ is raised where something comes much nearer than d̂
  PairCounting pair_counting;               // of the barrier
  double start_gap_d_hat = 0.0;             // gap of frame 0 between the object's lowest point and z = 0, in d̂
  std::optional<FrictionConfig> friction;
  double relative_velocity_tolerance = 0.0;  // Newton: max |p| / h below this part of the diagonal per second
  NewtonSettings newton;                     // all but the velocity tolerance; too many iterations halve a step
  LinearSolverKind linear_solver = LinearSolverKind::conjugate_gradient;
  int max_halvings = 0;  // of a time step; reaching it is a failure
  bool stress = false;   // Cauchy stress in the gels, pressure and shear on their fronts are measured

  static PressConfig read(ConfigReader& in);
  double coefficient_of_friction() const { return friction ? friction->coefficient : 0.0; }
  /// Whether a sensor's own coefficient takes the place of the configuration's: where that has any friction.
  bool takes_friction_of(const Sensor& sensor) const;
  /// Itself, with that coefficient where it does.
  PressConfig with_friction_of(const Sensor& sensor) const;
};

}  // namespace tacipc
