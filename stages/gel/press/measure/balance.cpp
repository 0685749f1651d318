#include "stages/gel/press/measure/balance.h"

#include <algorithm>
#include <cassert>

namespace tacipc {

Balance balance_of(const Positions& positions, const VertexForces& forces) {
  Vector3 torque = Vector3::Zero();
  const auto resultant = [&](const Positions& of_kind) {
    assert(of_kind.rows() == 0 || of_kind.rows() == positions.rows());
    Vector3 sum = Vector3::Zero();
    for (Eigen::Index v = 0; v < of_kind.rows(); ++v) {
      const Vector3 force = of_kind.row(v), arm = positions.row(v);
      sum += force;
      torque += arm.cross(force);
    }
    return sum;
  };
  Balance balance{.contact_n = resultant(forces.contact),
                  .inertia_n = resultant(forces.inertia),
                  .mount_n = resultant(forces.mount)};
  const Vector3 all_n = balance.contact_n + balance.inertia_n + balance.mount_n;
  balance.force_n = all_n.norm();
  balance.torque_n_m = torque.norm();
  balance.relative = balance.force_n / std::max(balance.contact_n.norm(), kSmallestContactN);
  return balance;
}

}  // namespace tacipc
