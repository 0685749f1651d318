// Restriction of an energy to a few of its stencils.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "stages/gel/press/energy/energy_term.h"

namespace tacipc {

/// Σ eᵢ over some stencils of a term: the part that changes while only some vertices move.
class RestrictedTerm final : public EnergyTerm {
 public:
  RestrictedTerm(std::shared_ptr<const EnergyTerm> whole, std::vector<int> stencils)
      : whole_(std::move(whole)), stencils_(std::move(stencils)) {}

  int num_stencils() const override { return static_cast<int>(stencils_.size()); }
  std::span<const int> stencil(int i) const override { return whole_->stencil(stencils_[i]); }
  void evaluate(int i, const Eigen::VectorXd& x, Order order, Local& out) const override {
    whole_->evaluate(stencils_[i], x, order, out);
  }

 private:
  std::shared_ptr<const EnergyTerm> whole_;
  std::vector<int> stencils_;
};

}  // namespace tacipc
