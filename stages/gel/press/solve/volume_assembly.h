// The part of Newton's system by which clusters couple all of their vertices through their volume.
#pragma once

#include <memory>
#include <vector>

#include "stages/gel/press/energy/averaged_elasticity.h"
#include "stages/gel/press/solve/assembly.h"
#include "stages/gel/press/solve/elastic_assembly.h"
#include "stages/gel/press/solve/separate_groups.h"

namespace tacipc {

/// Adds u″ ∂v ∂vᵀ of every cluster (averaged_elasticity.h). Where the blocks go is looked up once per pattern.
class VolumeAssembly {
 public:
  /// \pre both outlive it
  VolumeAssembly(const AveragedElasticity& elasticity, const FreeVertices& free);

  /// `second`: u″ of each cluster. \pre prescribed vertices of the gel stand still
  void add(const std::vector<double>& second, const Positions& x, double weight, NewtonSystem& system);
  /// The same to a system whose Hessian still holds what the last add() and update() put there: clusters with a
  /// tetrahedron in one of `changed` packs are renewed, and their rows marked.
  void update(const std::vector<double>& second, const Positions& x, const ElasticAssembly& changed,
              NewtonSystem& system, std::vector<char>& changed_rows);

 private:
  void look_up(const BlockPattern& pattern);

  struct Cluster {
    std::vector<int> members;  // of its stencil, those that are free, by their number among the free vertices
    std::vector<int> places;   // of blocks (i, j) with i ≥ j in that order, column by column
    /// What the Hessian holds: weight × u″, and ∂v of the members, four numbers each.
    double second = 0.0;
    Eigen::Matrix4Xd gradients = {};
  };
  void find_gradients(int c, const Positions& x, Eigen::Matrix3Xd& of_stencil, Eigen::Matrix4Xd& out) const;

  const AveragedElasticity& elasticity_;
  const FreeVertices& free_;
  SeparateGroups groups_;                        // of clusters
  std::shared_ptr<const BlockPattern> pattern_;  // that the places belong to
  std::vector<Cluster> clusters_;
  double weight_ = 0.0;
};

}  // namespace tacipc
