// Prescribed positions by an augmented Lagrangian.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "stages/gel/press/energy/energy_term.h"

namespace tacipc {

/// Energy Σ ½ k ‖xᵢ − tᵢ‖² − λᵢ·(xᵢ − tᵢ), J, over the listed vertices, with targets t, stiffness k in N/m and
/// multipliers λ: the force, N, that holds a vertex at its target once it is there [Li et al. 2020, supplement; method
/// of multipliers].
class Dirichlet final : public EnergyTerm {
 public:
  /// \param targets_m, multipliers_n one row per vertex
  Dirichlet(std::vector<int> vertices, Positions targets_m, Positions multipliers_n, double stiffness_n_m)
      : vertices_(std::move(vertices)),
        targets_m_(std::move(targets_m)),
        multipliers_n_(std::move(multipliers_n)),
        stiffness_n_m_(stiffness_n_m) {}

  int num_stencils() const override { return static_cast<int>(vertices_.size()); }
  std::span<const int> stencil(int i) const override { return {&vertices_[i], 1}; }
  void evaluate(int i, const Eigen::VectorXd& x, Order order, Local& out) const override {
    const Vector3 off = x.head<3>() - targets_m_.row(i).transpose();
    const Vector3 multiplier = multipliers_n_.row(i);
    out.zero = false;
    out.value = 0.5 * stiffness_n_m_ * off.squaredNorm() - multiplier.dot(off);
    if (order == Order::value) return;
    out.fit(1, order);
    out.gradient.head<3>() = stiffness_n_m_ * off - multiplier;
    if (order == Order::gradient) return;
    out.hessian.topLeftCorner<3, 3>() = stiffness_n_m_ * Matrix3::Identity();
  }

  /// Displacements of the vertices from their targets, m, one row each.
  Positions misses(const Positions& x) const {
    Positions out(targets_m_.rows(), 3);
    for (Eigen::Index i = 0; i < out.rows(); ++i) out.row(i) = x.row(vertices_[i]) - targets_m_.row(i);
    return out;
  }
  /// Largest norm of those rows that belong to a constrained vertex.
  double largest(const Positions& rows) const {
    double squared = 0.0;
    for (const int v : vertices_) squared = std::max(squared, rows.row(v).squaredNorm());
    return std::sqrt(squared);
  }
  /// Term for the next iteration: multipliers λ − k (x − t), stiffness times `stiffening`.
  Dirichlet renewed(const Positions& x, double stiffening) const {
    return {vertices_, targets_m_, multipliers_n_ - stiffness_n_m_ * misses(x), stiffening * stiffness_n_m_};
  }

 private:
  std::vector<int> vertices_;
  Positions targets_m_, multipliers_n_;
  double stiffness_n_m_;
};

}  // namespace tacipc
