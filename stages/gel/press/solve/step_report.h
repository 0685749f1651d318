// Results of a time step: its effort, its residuals and its forces.
#pragma once

#include <algorithm>
#include <vector>

#include "common/base/wrench.h"
#include "common/sample/contact_state.h"
#include "stages/gel/press/energy/affine_body.h"

namespace tacipc {

/// Lever arm, m, that turns the torque on a free body into an equivalent force.
inline constexpr double kBodyTorqueArm_m = 0.01;

/// Effort and residuals of a time step. Counters add up over the parts of a divided step.
struct StepReport {
  int time_steps = 0;           // 1, or more if the step had to be divided
  int newton_iterations = 0;    // including those that move the object; an iteration may solve several linear systems
  int moving_iterations = 0;    // iterations that move the object
  int patches = 0;              // local solves for a few vertices
  int patch_iterations = 0;     // Newton iterations in patches
  int lag_iterations = 0;       // friction updates, before iterations and at minima
  int exact_hessian_waits = 0;  // iterations within tolerance that only waited for the exact contact Hessian
  double approximated_share = 0.0;  // largest PSD share of the contact Hessian in the last Newton direction
  double velocity_residual_m_s = 0.0;
  /// Σ |residual force| over the free vertices. With several gels: the largest ratio of a gel's residual to its own
  /// limit, times the limit at contact_force_n.
  double force_residual_n = 0.0;
  double barrier_factor = 1.0;       // factor on the barrier's stiffness in this step
  double friction_residual_n = 0.0;  // residual force if friction were updated now
  /// |Σ contact forces| on the gel, with or without friction, whichever is smaller. With several gels: that of the gel
  /// in lightest contact; if no gel is touched, that of the soft body, then the rigid body, in lightest contact.
  double contact_force_n = 0.0;
  Vector3 object_shift_m = Vector3::Zero();  // translation of the object along its free axes
  /// Momentum balance of a free body: |Δmomentum / h − forces|, and the corresponding value for angular momentum about
  /// its centre. With several bodies: the one whose residual force, or residual torque / kBodyTorqueArm_m, is the
  /// largest fraction of its load.
  double body_residual_n = 0.0, body_residual_n_m = 0.0;
  double body_load_n = 0.0;  // weight of that body or load on it, whichever is larger

  /// Adds the effort of the preceding part of a divided step; the residuals remain those of this part.
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
  Positions normal;    // contact (barrier)
  Positions friction;  // friction
  Positions mount;     // reaction of the mount on the glued vertices; zero elsewhere
  Positions body;      // inertia (−m a), gravity and damping
  /// One per gel vertex. Slip: most of the vertex's normal force belongs to pairs that slide faster than ε_v.
  std::vector<ContactState> contact_state;
  /// Force-weighted mean gap between gel and objects, Σ λ d / Σ λ over their pairs, with λ the force and d the distance
  /// of a pair. Zero without contact.
  double stand_off_m = 0.0;
  /// Contact wrench on body a by body b about the world's origin, at index a × number of bodies + b (bodies as in
  /// ContactMesh::body_of()). Filled if an object may be free or the settings ask for it; else empty.
  std::vector<Wrench> between = {};
  double contact_j = 0.0;  // barrier energy
  double friction_loss_j = 0.0,
         damping_loss_j = 0.0;  // energy dissipated by friction and by stiffness damping in the step
};

}  // namespace tacipc
