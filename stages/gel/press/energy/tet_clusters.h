// Clusters: small neighbourhoods of tetrahedra that share one volume.
#pragma once

#include <vector>

#include "common/base/types.h"

namespace tacipc {

/// Tetrahedra of each cluster, ascending; every tetrahedron is in exactly one cluster.
using TetClusters = std::vector<std::vector<int>>;

/// Divides a mesh into clusters of about `size` tetrahedra, each compact and connected by faces. A cluster grows by the
/// neighbour that adds the fewest new vertices and, among these, whose vertices are shared with most of its tetrahedra,
/// so that it winds around a vertex. Seeds are the tetrahedra with the fewest free neighbours, so that few small groups
/// remain; a group smaller than half a cluster joins its smallest neighbour. Clusters thus have size/2 tetrahedra or
/// more (fewer only if a connected part of the mesh has fewer) and usually less than 3 size/2. The same mesh gives the
/// same clusters.
TetClusters make_tet_clusters(const Tetrahedra& tets, int size);

}  // namespace tacipc
