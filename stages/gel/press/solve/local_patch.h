// Patches: small sets of vertices that still move while all others are at rest.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "stages/gel/press/contact/contact_pair.h"
#include "stages/gel/press/energy/incremental_potential.h"
#include "stages/gel/press/solve/block_matrix.h"

namespace tacipc {

/// A patch: its vertices and the tetrahedra around them.
struct LocalPatch {
  std::vector<bool> moves;  // one per vertex: whether it may move
  FreeVertices free;        // the vertices that may move
  Tetrahedra tets;          // tetrahedra with at least one of these vertices
};

/// Tetrahedra around each vertex.
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

/// Growth of a patch: `rings` rings of tetrahedra, then up to `most_rings` until it has `fewest_vertices`.
struct PatchSize {
  int rings = 1;
  int fewest_vertices = 0, most_rings = 0;
};

/// Patch of the vertices `seeds` and their neighbours, without prescribed vertices.
LocalPatch grow_patch(const std::vector<int>& seeds, const PatchSize& size, const Tetrahedra& tets,
                      const TetsOfVertices& tets_of, const FreeVertices& all_free);

/// Restriction of a term to the stencils with a vertex that moves, part by part if it is a JoinedTerm.
/// \return null for a null term
std::shared_ptr<const EnergyTerm> restricted(const std::shared_ptr<const EnergyTerm>& term,
                                             const std::vector<bool>& moves);

/// Replaces the pairs of a patch after it has moved: pairs of `before` without a moving vertex, followed by `own`, all
/// pairs that have one.
std::vector<ContactPair> with_patch(std::vector<ContactPair> before, const std::vector<bool>& moves,
                                    const std::vector<ContactPair>& own);

}  // namespace tacipc
