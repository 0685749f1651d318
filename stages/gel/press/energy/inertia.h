// Inertia of lumped masses about the predicted positions.
#pragma once

#include <utility>
#include <vector>

#include "stages/gel/press/energy/energy_term.h"

namespace tacipc {

/// Energy Σ ½ mᵢ ‖xᵢ − x̂ᵢ‖², kg m² [Eq. 3].
class Inertia final : public EnergyTerm {
 public:
  /// \param mass_kg, x_hat_m one mass and one row per vertex; stencil i is vertex first_vertex + i
  Inertia(Eigen::VectorXd mass_kg, Positions x_hat_m, int first_vertex = 0)
      : mass_kg_(std::move(mass_kg)), x_hat_m_(std::move(x_hat_m)), vertex_(mass_kg_.size()) {
    for (std::size_t i = 0; i < vertex_.size(); ++i) vertex_[i] = first_vertex + static_cast<int>(i);
  }

  /// Restriction of `whole` to some of its stencils.
  Inertia(const Inertia& whole, const std::vector<int>& which)
      : mass_kg_(whole.mass_kg_(which)), x_hat_m_(whole.x_hat_m_(which, Eigen::all)) {
    for (const int i : which) vertex_.push_back(whole.vertex_[static_cast<std::size_t>(i)]);
  }

  int num_stencils() const override { return static_cast<int>(vertex_.size()); }
  std::span<const int> stencil(int i) const override { return {&vertex_[i], 1}; }
  void evaluate(int i, const Eigen::VectorXd& x, Order order, Local& out) const override {
    out.zero = false;
    out.value = 0.5 * mass_kg_[i] * (x.head<3>() - x_hat_m_.row(i).transpose()).squaredNorm();
    if (order == Order::value) return;
    out.fit(1, order);
    out.gradient.head<3>() = gradient(i, x.head<3>());
    if (order == Order::gradient) return;
    out.hessian.topLeftCorner<3, 3>() = mass_kg_[i] * Matrix3::Identity();
  }

  double mass_kg(int i) const { return mass_kg_[i]; }
  /// Gradient mᵢ (x − x̂ᵢ) of stencil i with its vertex at x.
  Vector3 gradient(int i, const Vector3& x) const { return mass_kg_[i] * (x - x_hat_m_.row(i).transpose()); }

 private:
  Eigen::VectorXd mass_kg_;
  Positions x_hat_m_;
  std::vector<int> vertex_;
};

}  // namespace tacipc
