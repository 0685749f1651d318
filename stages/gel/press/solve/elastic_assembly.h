// Assembly of the elasticity into the Newton system, for elements that are evaluated in packs.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "stages/gel/press/energy/elastic_packs.h"
#include "stages/gel/press/solve/assembly.h"
#include "stages/gel/press/solve/separate_groups.h"

namespace tacipc {

/// Adds the exact derivatives of the packed elements of one elasticity to a system. The destination of each block of
/// each element is looked up once per pattern.
class ElasticAssembly {
 public:
  /// \pre `packs` and `free` outlive it
  ElasticAssembly(const ElasticPacks& packs, const FreeVertices& free);

  /// Adds gradient and Hessian.
  /// \param pressure see ElasticPacks::derivatives, pack by pack; may be empty
  /// \pre prescribed vertices of the gel do not move
  void add(const Positions& x, std::span<const double> pressure, double weight, NewtonSystem& system);
  /// Updates a system whose Hessian still holds the values of the last add() or update(). The gradient is exact. The
  /// Hessian of a pack is recomputed, and its rows are marked, if it has changed by more than `tolerance`
  /// (ElasticPacks::change).
  void update(const Positions& x, std::span<const double> pressure, double tolerance, NewtonSystem& system,
              std::vector<char>& changed_rows);
  /// Whether the last add() or update() changed a pack's Hessian.
  bool changed(int pack) const { return changed_[static_cast<std::size_t>(pack)] != 0; }

 private:
  void add_gradient(int pack, const ElasticPacks::Derivatives& found, NewtonSystem& system) const;
  void add_hessian(int pack, const ElasticPacks::Derivatives& found, NewtonSystem& system) const;
  void look_up(const BlockPattern& pattern);

  const ElasticPacks& packs_;
  const FreeVertices& free_;
  SeparateGroups groups_;                        // groups of packs
  std::shared_ptr<const BlockPattern> pattern_;  // pattern of places_ and none_transposed_
  /// Destination of each block: its index in the matrix, −1 − its index if it is stored transposed, or kNowhere.
  std::vector<std::array<std::array<int, kLanes>, ElasticPacks::kBlocks>> places_;
  std::vector<bool> none_transposed_;  // per pack: none of its blocks is stored transposed
  double weight_ = 0.0;
  std::vector<ElasticPacks::State> states_;  // per pack: state at which its Hessian was computed
  std::vector<char> changed_;                // per pack: whether the last call changed its Hessian
};

}  // namespace tacipc
