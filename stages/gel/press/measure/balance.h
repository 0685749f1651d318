// Whether the forces on the gel add up: contact + inertia + damping + gravity + mount = 0.
#pragma once

#include "common/base/types.h"

namespace tacipc {

/// Forces on every gel vertex, N, #V × 3 each, all as forces on the gel: inertia is −m a (d'Alembert) with damping and
/// gravity, mount what the mount does to the glued face. An array without rows stands for zero.
struct VertexForces {
  Positions contact = {};
  Positions inertia = {};
  Positions mount = {};
};

/// No contact force counts as smaller than this: beside less, the solver's residual would look like a large imbalance.
inline constexpr double kSmallestContactN = 0.01;

struct Balance {
  double force_n = 0.0;     // |Σ of all|
  double torque_n_m = 0.0;  // |Σ x × f| about the origin of S
  double relative = 0.0;    // force_n / max(|Σ contact|, kSmallestContactN)
  Vector3 contact_n = Vector3::Zero();
  Vector3 inertia_n = Vector3::Zero();
  Vector3 mount_n = Vector3::Zero();
};

/// Sums the forces in the order of the vertices. Internal forces cancel and are not needed, so the sum is the solver's
/// residual: the balance checks it by other means. \pre arrays have no rows or those of
/// `positions`
Balance balance_of(const Positions& positions, const VertexForces& forces);

}  // namespace tacipc
