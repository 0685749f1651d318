// Sum of the energies of several bodies.
#pragma once

#include <memory>
#include <vector>

#include "stages/gel/press/energy/energy_term.h"

namespace tacipc {

/// Sum over parts that share no vertex, such as bodies of different materials: the stencils of the first part, then
/// those of the second, and so on. Each part remains a term of its own, so that a solver can treat it by its kind
/// (parts_of).
class JoinedTerm final : public EnergyTerm {
 public:
  /// \pre no part is null
  explicit JoinedTerm(std::vector<std::shared_ptr<const EnergyTerm>> parts);

  int num_stencils() const override { return first_.back(); }
  std::span<const int> stencil(int i) const override {
    const auto [part, own] = find(i);
    return parts_[part]->stencil(own);
  }
  void evaluate(int i, const Eigen::VectorXd& x, Order order, Local& out) const override {
    const auto [part, own] = find(i);
    parts_[part]->evaluate(own, x, order, out);
  }

  double value(const Positions& x) const override;

  const std::vector<std::shared_ptr<const EnergyTerm>>& parts() const { return parts_; }

 private:
  struct Place {
    std::size_t part;
    int own;  // index of the stencil within the part
  };
  Place find(int i) const;

  std::vector<std::shared_ptr<const EnergyTerm>> parts_;
  std::vector<int> first_;  // first stencil of each part, then the total number
};

/// Parts of a joined term; any other term alone; empty for null.
std::vector<std::shared_ptr<const EnergyTerm>> parts_of(const std::shared_ptr<const EnergyTerm>& term);

}  // namespace tacipc
