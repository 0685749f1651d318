// A few vertices that still move while all others are at rest.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "stages/gel/press/contact/contact_pair.h"
#include "stages/gel/press/energy/incremental_potential.h"
#include "stages/gel/press/solve/block_matrix.h"

namespace tacipc {

/// Vertices that may move, and what of the gel they are part of.
struct LocalPatch {
  std::vector<bool> moves;  // per vertex
  FreeVertices free;        // those vertices
  Tetrahedra tets;          // with any of them
};

/// Which tetrahedra each vertex is part of.
class TetsOfVertices {
 public:
  TetsOfVertices(const Tetrahedra& tets, Eigen::Index num_vertices);
  std::span<const int> operator[](int vertex) const {
    const auto v = static_cast<std::size_t>(vertex);
    return std::span(tets_).subspan(start_[v], start_[v + 1] - start_[v]);
  }

 private:
  std::vector<std::size_t> start_;
  std::vector<int> tets_;
};

/// How far a patch grows: so many rings of tetrahedra, and further ones until it has so many vertices.
struct PatchSize {
  int rings = 1;
  int fewest_vertices = 0, most_rings = 0;
};

/// The vertices of `seeds` and their neighbours, without those that are prescribed.
LocalPatch grow_patch(const std::vector<int>& seeds, const PatchSize& size, const Tetrahedra& tets,
                      const TetsOfVertices& tets_of, const FreeVertices& all_free);

/// The term's stencils with any vertex that moves, part by part where it is joined of several; null for null.
std::shared_ptr<const EnergyTerm> restricted(const std::shared_ptr<const EnergyTerm>& term,
                                             const std::vector<bool>& moves);

/// The pairs `before` without those that have a vertex that moves, and after them the patch's `own`, which are all of
/// those: what is near once the patch has moved.
std::vector<ContactPair> with_patch(std::vector<ContactPair> before, const std::vector<bool>& moves,
                                    const std::vector<ContactPair>& own);

}  // namespace tacipc
