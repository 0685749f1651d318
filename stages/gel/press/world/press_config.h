// Configuration of the press stage: numerics that hold for a dataset.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/config/config.h"
#include "common/sensor/sensor.h"
#include "stages/gel/press/solve/step_settings.h"

namespace tacipc {

/// Smoothed Coulomb friction between object and gel, and within the gel.
struct FrictionConfig {
  double coefficient = 0.0;               // μ
  double relative_speed_threshold = 0.0;  // ε_v / gel diagonal, 1/s: slower sliding counts as sticking
  bool iterated = false;        // update normal forces and tangent planes until they match; false: once per step
  bool only_at_minima = false;  // iterated: update at minima only, not before Newton iterations
  int max_lag_iterations = 0;   // iterated: largest number of updates at minima
  double relative_lag_tolerance = 0.0;  // residual force after an update / contact force

  static FrictionConfig read(ConfigReader& in);
  static Range coefficients() { return {.low = 0.0, .high = 10.0}; }
};

/// A file of configs/press/.
struct PressConfig {
  double time_step_s = 0.0;
  bool quasi_static = false;  // the gel has no inertia
  Vector3 gravity_m_s2 = Vector3::Zero();
  double mass_damping_per_s = 0.0;    // Rayleigh damping: factor on the mass matrix
  double stiffness_damping_s = 0.0;   // Rayleigh damping: factor on the stiffness matrix
  std::string element;                // "auto", "linear" or "averaged_volume"
  bool augmented_lagrangian = false;  // hold glued face and object by multipliers; false: eliminate them
  double relative_d_hat = 0.0;        // d̂ / diagonal of the undeformed gel's bounding box
  std::optional<double> barrier_stiffness;  // κ of κ B(x) next to h² Φ(x), with squared distances: J s² / m⁴ = kg m⁻²
  double relative_barrier_stiffness = 0.2;  // if κ is absent: κ d̂³ / (h² E ℓ²), ℓ the median edge of the front
  bool adaptive_barrier_stiffness = false;  // raise κ if a gap becomes much smaller than d̂
  PairCounting pair_counting;               // weights of the barrier's pairs
  double start_gap_d_hat = 0.0;             // gap in frame 0 between the object's lowest point and z = 0, in d̂
  std::optional<FrictionConfig> friction;
  double relative_velocity_tolerance = 0.0;  // Newton: limit of max |p| / h / diagonal, 1/s
  NewtonSettings newton;  // all settings except the velocity tolerance; too many iterations halve a step
  LinearSolverKind linear_solver = LinearSolverKind::conjugate_gradient;
  int max_halvings = 0;  // largest number of halvings of a time step; reaching it is an error
  bool stress = false;   // measure Cauchy stress in the gels, pressure and shear on their fronts

  static PressConfig read(ConfigReader& in);
  double coefficient_of_friction() const { return friction ? friction->coefficient : 0.0; }
  /// Whether a sensor's own coefficient of friction replaces that of the configuration, which must have friction.
  bool takes_friction_of(const Sensor& sensor) const;
  /// Copy of the configuration, with the sensor's coefficient if takes_friction_of().
  PressConfig with_friction_of(const Sensor& sensor) const;
};

}  // namespace tacipc
