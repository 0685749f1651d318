// The gel's own part of Newton's system, where its elements come in packs.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "stages/press/energy/elastic_packs.h"
#include "stages/press/solve/assembly.h"
#include "stages/press/solve/separate_groups.h"

namespace tacipc {

/// Adds the exact derivatives of packed elements to a system. Where each block of each element goes is looked up once
/// per pattern.
class ElasticAssembly {
 public:
  /// `pressure`: of ElasticPacks::derivatives, pack by pack, or nothing. \pre prescribed vertices of the gel stand
  /// still; `free` is the same in every call
  void add(const ElasticPacks& packs, const Positions& x, std::span<const double> pressure, double weight,
           const FreeVertices& free, NewtonSystem& system);

 private:
  void look_up(const ElasticPacks& packs, const FreeVertices& free);

  std::shared_ptr<const BlockPattern> pattern_;
  /// Block of the matrix: its index, or −1 − its index where it lies transposed, or kNowhere.
  std::vector<std::array<std::array<int, kLanes>, ElasticPacks::kBlocks>> places_;
  std::vector<bool> none_transposed_;  // of a pack's blocks
  SeparateGroups groups_;              // of packs
};

}  // namespace tacipc
