// What tetrahedra that share their volume add to Newton's system beyond themselves.
#pragma once

#include <memory>
#include <vector>

#include "stages/press/energy/averaged_elasticity.h"
#include "stages/press/solve/assembly.h"
#include "stages/press/solve/separate_groups.h"

namespace tacipc {

/// Adds u″ ∂v ∂vᵀ of every patch (averaged_elasticity.h). Where the blocks go is looked up once per pattern.
class VolumeAssembly {
 public:
  /// `second`: u″ of each patch. \pre prescribed vertices of the gel stand still; `free` is the same in every call
  void add(const AveragedElasticity& elasticity, const std::vector<double>& second, const Positions& x, double weight,
           const FreeVertices& free, NewtonSystem& system);

 private:
  void look_up(const AveragedElasticity& elasticity, const FreeVertices& free);

  struct Patch {
    std::vector<int> members;  // of its stencil, those that are free, by their number among the free vertices
    std::vector<int> places;   // of blocks (i, j) with i ≥ j in that order, column by column
  };
  std::shared_ptr<const BlockPattern> pattern_;
  std::vector<Patch> patches_;
  SeparateGroups groups_;
};

}  // namespace tacipc
