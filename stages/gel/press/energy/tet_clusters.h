// Small neighbourhoods of tetrahedra that share one measure of volume.
#pragma once

#include <vector>

#include "common/base/types.h"

namespace tacipc {

/// Tetrahedra of each cluster, ascending; every tetrahedron is in exactly one cluster.
using TetClusters = std::vector<std::vector<int>>;

/// Divides a mesh into clusters of about `size` tetrahedra, each connected by faces and compact: a cluster grows by the
/// neighbour that brings the fewest new vertices and lies at those it has most in common with, which winds it about one
/// of them. Seeds are the tetrahedra with the fewest free neighbours, so that few small groups remain; a group smaller
/// than half a cluster joins its smallest neighbour, so clusters have size/2 tetrahedra or more (fewer only where a
/// connected part of the mesh has no more) and as a rule less than 3 size/2. The same mesh gives the same clusters.
TetClusters make_tet_clusters(const Tetrahedra& tets, int size);

}  // namespace tacipc
