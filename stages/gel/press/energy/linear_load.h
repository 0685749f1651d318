// Loads that do not depend on the motion: gravity, or forces on some vertices.
#pragma once

#include <cassert>
#include <utility>
#include <vector>

#include "stages/gel/press/energy/energy_term.h"

namespace tacipc {

/// Energy −Σ fᵢ · xᵢ over the listed vertices, J; row i of `force_n` acts on vertices[i]. Gravity is mᵢ g on every
/// vertex.
class LinearLoad final : public EnergyTerm {
 public:
  /// \pre `force_n` has one row per vertex
  LinearLoad(std::vector<int> vertices, Positions force_n)
      : vertices_(std::move(vertices)), force_n_(std::move(force_n)) {
    assert(static_cast<Eigen::Index>(vertices_.size()) == force_n_.rows());
  }

  int num_stencils() const override { return static_cast<int>(vertices_.size()); }
  std::span<const int> stencil(int i) const override { return {&vertices_[i], 1}; }
  void evaluate(int i, const Eigen::VectorXd& x, Order order, Local& out) const override {
    out.zero = false;
    out.value = -force_n_.row(i).dot(x);
    out.fit(1, order);
    if (order >= Order::gradient) out.gradient = -force_n_.row(i).transpose();
    if (order >= Order::hessian) out.hessian.setZero();
  }

 private:
  std::vector<int> vertices_;
  Positions force_n_;
};

}  // namespace tacipc
