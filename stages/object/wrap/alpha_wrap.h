// CGAL's alpha wrap: a closed surface around any other surface.
#pragma once

#include "common/mesh/triangle_mesh.h"

namespace tacipc {

/// Surface that remains when a ball of radius alpha carves away the space around a mesh without coming nearer than the
/// offset [Portaneri2022]. It is closed and outward, every edge is in two faces, no faces cross, and the whole mesh
/// lies inside. Its faces are about alpha wide. Holes and grooves narrower than the ball are bridged; where the ball
/// enters an open surface, that becomes a wall of two offsets.
/// \throw DataError if no face has an area or CGAL fails
TriangleMesh alpha_wrap(const TriangleMesh& mesh, double alpha_m, double offset_m);

}  // namespace tacipc
