// Settings of the solver that stay the same during a simulation.
#pragma once

#include <algorithm>
#include <optional>

#include "stages/gel/press/contact/contact_laws.h"
#include "stages/gel/press/contact/pair_counting.h"
#include "stages/gel/press/solve/linear_solver.h"

namespace tacipc {

/// When a step counts as solved, and what it may cost.
struct NewtonSettings {
  double velocity_tolerance_m_s = 0.0;     // max |p| / h of the Newton step p, below which it has converged …
  double relative_force_tolerance = 5e-4;  // … if residual forces also sum to less than this part of the contact force
  double force_tolerance_n = 1e-5;         // … or to less than this
  int max_iterations = 200;                // of a time step, renewals of friction included; reaching it is a failure
  bool adaptive_contact_hessian = true;    // blend of the exact one and its PSD approximation, else the latter alone
  bool patches = true;                     // solves for the last few moving vertices alone in between

  /// What residual forces may sum to beside this contact force.
  double force_limit_n(double contact_force_n) const {
    return std::max(force_tolerance_n, relative_force_tolerance * contact_force_n);
  }
};

struct FrictionSettings {
  double speed_threshold_m_s = 0.0;     // ε_v
  int max_lag_iterations = 1;           // 1: normal forces and tangent planes of the start of the step
  bool renewed_only_at_minima = false;  // else before each iteration of Newton's method, too
  double relative_lag_tolerance = 0.0;
};

/// What holds during a whole simulation.
struct StepSettings {
  ContactLaws laws = ContactLaws();     // of each two bodies
  double front_edge_m = 0.0;            // median edge of the gel's front
  double barrier_stiffness_j_m4 = 0.0;  // κ/h² of the nominal time step, which a divided step keeps
  bool adaptive_barrier = false;        // State::barrier_factor grows where gaps get small
  PairCounting pair_counting = {};
  std::optional<FrictionSettings> friction = std::nullopt;
  bool quasi_static = false;
  bool augmented_lagrangian = false;  // glued and object vertices by multipliers, else eliminated
  Vector3 gravity_m_s2 = Vector3::Zero();
  double mass_damping_per_s = 0.0;
  double stiffness_damping_s = 0.0;
  bool wrenches_between_bodies = false;  // StepForces::between, without bodies that may be free, too
  LinearSolverKind linear_solver = LinearSolverKind::direct;
  NewtonSettings newton;
};

}  // namespace tacipc
