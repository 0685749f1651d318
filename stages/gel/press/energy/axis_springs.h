// Springs on an object as a whole along its free axes: its inertia, or a compliant mount.
#pragma once

#include "stages/gel/press/energy/energy_term.h"

namespace tacipc {

/// Energy Σ_a ½ k_a (x_a − t_a)² over the axes a of one vertex, in the unit of k times m². Under a load, the inertia of
/// an implicit Euler step is a spring with k = m and the target x̂. A mount of compliance c is a spring with k = h²/c,
/// whose target is the position on a rigid mount.
class AxisSprings final : public EnergyTerm {
 public:
  /// \pre no stiffness is negative, one is positive
  AxisSprings(int vertex, const Vector3& stiffness, const Vector3& target_m)
      : vertex_(vertex),
        stiffness_(stiffness),
        largest_(stiffness.maxCoeff()),
        shares_((stiffness / largest_).cwiseSqrt()),
        target_m_(target_m) {}

  int num_stencils() const override { return 1; }
  std::span<const int> stencil(int) const override { return {&vertex_, 1}; }
  void evaluate(int, const Eigen::VectorXd& x, Order order, Local& out) const override {
    out.zero = false;
    const Vector3 way = x.head<3>() - target_m_;
    out.value = 0.5 * largest_ * shares_.cwiseProduct(way).squaredNorm();
    if (order == Order::value) return;
    out.fit(1, order);
    out.gradient.head<3>() = stiffness_.cwiseProduct(way);
    if (order == Order::gradient) return;
    out.hessian.topLeftCorner<3, 3>() = stiffness_.asDiagonal();
  }

 private:
  int vertex_;
  Vector3 stiffness_;
  double largest_;
  Vector3 shares_;  // √(stiffness / largest stiffness)
  Vector3 target_m_;
};

}  // namespace tacipc
