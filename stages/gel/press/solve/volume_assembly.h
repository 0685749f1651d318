// Assembly of the blocks by which clusters couple all of their vertices through their volume.
#pragma once

#include <memory>
#include <vector>

#include "stages/gel/press/energy/averaged_elasticity.h"
#include "stages/gel/press/solve/assembly.h"
#include "stages/gel/press/solve/elastic_assembly.h"
#include "stages/gel/press/solve/separate_groups.h"

namespace tacipc {

/// Adds u″ ∂v ∂vᵀ of every cluster (averaged_elasticity.h). The destinations of the blocks are looked up once per
/// pattern.
class VolumeAssembly {
 public:
  /// \pre `elasticity` and `free` outlive it
  VolumeAssembly(const AveragedElasticity& elasticity, const FreeVertices& free);

  /// Adds all clusters. \param second u″ of each cluster \pre prescribed vertices of the gel do not move
  void add(const std::vector<double>& second, const Positions& x, double weight, NewtonSystem& system);
  /// Updates a system whose Hessian still holds the values of the last add() or update(): recomputes clusters with a
  /// tetrahedron in a pack that `changed` reports as changed, and marks their rows.
  void update(const std::vector<double>& second, const Positions& x, const ElasticAssembly& changed,
              NewtonSystem& system, std::vector<char>& changed_rows);

 private:
  void look_up(const BlockPattern& pattern);

  struct Cluster {
    std::vector<int> members;  // free members of the stencil, by their number among the free vertices
    std::vector<int> places;   // destinations of blocks (i, j), i ≥ j in that order, column by column
    /// Values in the Hessian: weight × u″, and ∂v of the members, four numbers each.
    double second = 0.0;
    Eigen::Matrix4Xd gradients = {};
  };
  void find_gradients(int c, const Positions& x, Eigen::Matrix3Xd& of_stencil, Eigen::Matrix4Xd& out) const;

  const AveragedElasticity& elasticity_;
  const FreeVertices& free_;
  SeparateGroups groups_;                        // groups of clusters
  std::shared_ptr<const BlockPattern> pattern_;  // pattern of the destinations
  std::vector<Cluster> clusters_;
  double weight_ = 0.0;
};

}  // namespace tacipc
