// Small neighbourhoods of tetrahedra that share one measure of volume.
#pragma once

#include <vector>

#include "common/types.h"

namespace tacipc {

/// Tetrahedra of each patch, ascending; every tetrahedron is in exactly one patch.
using TetPatches = std::vector<std::vector<int>>;

/// Divides a mesh into patches of about `size` tetrahedra, each connected by faces and compact: a patch grows by the
/// neighbour that brings the fewest new vertices and lies at those it has most in common with, which winds it about one
/// of them. Seeds are the tetrahedra with the fewest free neighbours, so that little is left over; what is smaller than
/// half a patch joins its smallest neighbour, so patches have size/2 tetrahedra or more (fewer only where a connected
/// part of the mesh has no more) and as a rule less than 3 size/2. The same mesh gives the same patches.
TetPatches make_tet_patches(const Tetrahedra& tets, int size);

}  // namespace tacipc
