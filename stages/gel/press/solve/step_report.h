// Results of a time step: the work it took, how far from balance it ended, and its forces.
#pragma once

#include <algorithm>
#include <vector>

#include "common/base/wrench.h"
#include "common/sample/contact_state.h"
#include "stages/gel/press/energy/affine_body.h"

namespace tacipc {

/// Torque on a free object counts like a force on an arm of this length, m.
inline constexpr double kBodyTorqueArm_m = 0.01;

/// What a step took and where it ended.
struct StepReport {
  int time_steps = 0;           // more than asked for where a step had to be divided
  int newton_iterations = 0;    // linear systems solved, those that moved the object included
  int moving_iterations = 0;    // those that moved the object
  int patches = 0;              // times that a few vertices were solved for alone,
  int patch_iterations = 0;     // and Newton iterations of those
  int lag_iterations = 0;       // how often friction was renewed, before iterations and at minima
  int exact_hessian_waits = 0;  // iterations that were within the tolerances and went on for want of the exact Hessian
  double approximated_share = 0.0;  // largest share of the contact Hessian's PSD approximation in the last direction
  double velocity_residual_m_s = 0.0;
  /// Σ over free vertices of |residual force|; of several gels the one where it is the largest part of what it may be
  /// there, times what it may be at contact_force_n.
  double force_residual_n = 0.0;
  double barrier_factor = 1.0;       // on the barrier's stiffness
  double friction_residual_n = 0.0;  // residual force if normal forces and tangent planes were renewed now
  /// |Σ contact forces on the gel|, with or without friction: the less; of several gels on the one touched least, where
  /// none is touched on a body.
  double contact_force_n = 0.0;
  Vector3 object_shift_m = Vector3::Zero();  // displacement of the object along its free axes
  /// Of a free object, |change of momentum / h − the forces on it| and the same of angular momentum about its centre;
  /// of several, of the one where either, the latter over kBodyTorqueArm_m, is the largest fraction of the load.
  double body_residual_n = 0.0, body_residual_n_m = 0.0;
  double body_load_n = 0.0;  // its weight or the load on it, whichever is larger

  /// Makes it that of this step and of those `before` it: what they took together, and where the last one ended.
  void add_earlier(const StepReport& before) {
    time_steps += before.time_steps;
    newton_iterations += before.newton_iterations;
    moving_iterations += before.moving_iterations;
    patches += before.patches;
    patch_iterations += before.patch_iterations;
    lag_iterations += before.lag_iterations;
    exact_hessian_waits += before.exact_hessian_waits;
    approximated_share = std::max(approximated_share, before.approximated_share);
  }
};

/// Forces on the gel's vertices at the end of a step, N, one row per gel vertex.
struct StepForces {
  Positions normal;    // by contact
  Positions friction;  // by friction
  Positions mount;     // on the glued vertices, by the mount; zero elsewhere
  Positions body;      // inertia (−m a), gravity and damping
  /// Per gel vertex; slip where most of its normal force belongs to pairs that slide faster than ε_v.
  std::vector<ContactState> contact_state;
  /// Σ λ d / Σ λ over the pairs of gel and object, λ the force and d the distance between the two sides of each: the
  /// mean gap between the surfaces where they press on each other. Zero where nothing touches.
  double stand_off_m = 0.0;
  /// By the contact of one body with another (ContactMesh::body_of()), about the world's origin: on body a by body b at
  /// a × number of bodies + b. Where any object may be free, or asked for; else empty.
  std::vector<Wrench> between = {};
  double contact_j = 0.0;                              // energy of the barrier
  double friction_loss_j = 0.0, damping_loss_j = 0.0;  // what friction and stiffness damping took in the step
};

}  // namespace tacipc
