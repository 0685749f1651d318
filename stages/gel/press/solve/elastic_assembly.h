// The elasticity's part of Newton's system, where its elements come in packs.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "stages/gel/press/energy/elastic_packs.h"
#include "stages/gel/press/solve/assembly.h"
#include "stages/gel/press/solve/separate_groups.h"

namespace tacipc {

/// Adds the exact derivatives of the packed elements of one elasticity to a system. Where each block of each element
/// goes is looked up once per pattern.
class ElasticAssembly {
 public:
  /// \pre both outlive it
  ElasticAssembly(const ElasticPacks& packs, const FreeVertices& free);

  /// `pressure`: of ElasticPacks::derivatives, pack by pack, or nothing. \pre prescribed vertices of the gel stand
  /// still
  void add(const Positions& x, std::span<const double> pressure, double weight, NewtonSystem& system);
  /// The same to a system whose Hessian still holds what the last add() and update() put there: the Hessians of packs
  /// are renewed, and their rows marked, in which one has changed by more than `tolerance` (ElasticPacks::change), the
  /// gradient is exact.
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
  SeparateGroups groups_;                        // of packs
  std::shared_ptr<const BlockPattern> pattern_;  // that the two below belong to
  /// Block of the matrix: its index, or −1 − its index where it lies transposed, or kNowhere.
  std::vector<std::array<std::array<int, kLanes>, ElasticPacks::kBlocks>> places_;
  std::vector<bool> none_transposed_;  // of a pack's blocks
  double weight_ = 0.0;
  std::vector<ElasticPacks::State> states_;  // where the Hessians are those of
  std::vector<char> changed_;
};

}  // namespace tacipc
