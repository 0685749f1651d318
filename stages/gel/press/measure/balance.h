// Balance of forces on the gel: contact + inertia + damping + gravity + mount = 0.
#pragma once

#include "common/base/types.h"

namespace tacipc {

/// Forces on every gel vertex, N, #V × 3 each, acting on the gel. `inertia` is −m a (d'Alembert) with damping and
/// gravity; `mount` is the reaction of the mount on the glued face. An array without rows means zero.
struct VertexForces {
  Positions contact = {};
  Positions inertia = {};
  Positions mount = {};
};

/// Smallest contact force, N, by which a residual is divided; with a smaller one the solver's residual would look like
/// a large imbalance.
inline constexpr double kSmallestContactN = 0.01;

/// Residuals of the balance, and the sums of the forces.
struct Balance {
  double force_n = 0.0;     // |Σ forces|
  double torque_n_m = 0.0;  // |Σ x × f| about the origin of S
  double relative = 0.0;    // force_n / max(|Σ contact|, kSmallestContactN)
  Vector3 contact_n = Vector3::Zero();
  Vector3 inertia_n = Vector3::Zero();
  Vector3 mount_n = Vector3::Zero();
};

/// Sums the forces in the order of the vertices. Internal forces cancel and are not needed, so the sum is an
/// independent check of the solver's residual.
/// \pre arrays have no rows, or as many as `positions`
Balance balance_of(const Positions& positions, const VertexForces& forces);

}  // namespace tacipc
