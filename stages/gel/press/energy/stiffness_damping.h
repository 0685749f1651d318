// Stiffness-proportional damping: the part of Rayleigh damping that acts on the strain rate.
#pragma once

#include <memory>
#include <utility>

#include "stages/gel/press/energy/energy_term.h"

namespace tacipc {

/// Energy E(x) = ½ (x − x_t)ᵀ K_t (x − x_t), J, with K_t the PSD projection of the elastic Hessian at x_t, the start of
/// the step. With weight hβ in the incremental potential, its force is −β K_t v for the velocity v = (x − x_t)/h
/// [Rayleigh 1877; implicit Euler]. Translation is not damped, nor is rotation of an unstressed gel. Only x_t is
/// stored: K_t is evaluated again, stencil by stencil, which costs as much as projecting the elasticity.
class StiffnessDamping final : public EnergyTerm {
 public:
  /// \param start_m x_t, one row per vertex, where the elasticity is finite
  StiffnessDamping(std::shared_ptr<const EnergyTerm> elasticity, Positions start_m)
      : elasticity_(std::move(elasticity)), start_m_(std::move(start_m)) {}

  int num_stencils() const override { return elasticity_->num_stencils(); }
  std::span<const int> stencil(int i) const override { return elasticity_->stencil(i); }
  void evaluate(int i, const Eigen::VectorXd& x, Order /*any: the Hessian comes first*/, Local& out) const override {
    const std::span<const int> vertices = stencil(i);
    Eigen::VectorXd start(x.size());
    for (Eigen::Index k = 0; k < x.size() / 3; ++k) start.segment<3>(3 * k) = start_m_.row(vertices[k]);
    elasticity_->evaluate(i, start, Order::psd, out);
    if (out.zero) return;
    const Eigen::VectorXd moved = x - start;
    out.gradient.noalias() = out.hessian * moved;
    out.value = 0.5 * moved.dot(out.gradient);
  }

 private:
  std::shared_ptr<const EnergyTerm> elasticity_;
  Positions start_m_;
};

}  // namespace tacipc
