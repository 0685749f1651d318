// A few vertices that still move while all others are at rest.
#pragma once

#include <memory>
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

/// The vertices of `seeds` and their neighbours, `rings` tetrahedra far, without those that are prescribed.
LocalPatch grow_patch(const std::vector<int>& seeds, int rings, const Tetrahedra& tets, const FreeVertices& all_free);

/// The term's stencils with any vertex that moves, part by part where it is joined of several; null for null.
std::shared_ptr<const EnergyTerm> restricted(const std::shared_ptr<const EnergyTerm>& term,
                                             const std::vector<bool>& moves);

/// The pairs `before` without those that have a vertex that moves, and after them the patch's `own`, which are all of
/// those: what is near once the patch has moved.
std::vector<ContactPair> with_patch(std::vector<ContactPair> before, const std::vector<bool>& moves,
                                    const std::vector<ContactPair>& own);

}  // namespace tacipc
