// Settings of the solver that are constant over a simulation.
#pragma once

#include <algorithm>
#include <optional>

#include "stages/gel/press/contact/contact_laws.h"
#include "stages/gel/press/contact/pair_counting.h"
#include "stages/gel/press/solve/linear_solver.h"

namespace tacipc {

/// Convergence criteria and effort limit of a time step. A step has converged if the velocity criterion and the force
/// criterion both hold.
struct NewtonSettings {
  double velocity_tolerance_m_s = 0.0;     // velocity criterion: max |p| / h, p the Newton step
  double relative_force_tolerance = 5e-4;  // force criterion: Σ |residual force| / contact force, or
  double force_tolerance_n = 1e-5;         // force criterion: Σ |residual force|, whichever limit is larger
  int max_iterations = 200;                // per time step, over all friction updates; reaching it is an error
  /// Blend the exact contact Hessian with its PSD approximation; false: use the approximation only.
  bool adaptive_contact_hessian = true;
  bool patches = true;  // between iterations, solve separately for the last few vertices that still move

  /// Largest allowed Σ |residual force| at this contact force.
  double force_limit_n(double contact_force_n) const {
    return std::max(force_tolerance_n, relative_force_tolerance * contact_force_n);
  }
};

/// Regularisation of friction, and updates of its lagged normal forces and tangent planes.
struct FrictionSettings {
  double speed_threshold_m_s = 0.0;     // ε_v: slower sliding counts as sticking
  int max_lag_iterations = 1;           // 1: lagged once per step; more: largest number of updates at minima
  bool renewed_only_at_minima = false;  // false: also update before Newton iterations
  double relative_lag_tolerance = 0.0;  // friction residual / contact force at which updates stop
};

/// Settings that are constant over a simulation.
struct StepSettings {
  ContactLaws laws = ContactLaws();     // contact laws of each pair of bodies
  double front_edge_m = 0.0;            // median edge length of the gel's front
  double barrier_stiffness_j_m4 = 0.0;  // κ / h² for the nominal time step; a divided step keeps it
  bool adaptive_barrier = false;        // State::barrier_factor grows if gaps become small
  PairCounting pair_counting = {};
  std::optional<FrictionSettings> friction = std::nullopt;
  bool quasi_static = false;          // the gel has no inertia
  bool augmented_lagrangian = false;  // hold glued and object vertices by multipliers; false: eliminate them
  Vector3 gravity_m_s2 = Vector3::Zero();
  double mass_damping_per_s = 0.0;
  double stiffness_damping_s = 0.0;
  bool wrenches_between_bodies = false;  // fill StepForces::between even if no body may be free
  LinearSolverKind linear_solver = LinearSolverKind::direct;
  NewtonSettings newton;
};

}  // namespace tacipc
