// CGAL's alpha wrap: a closed surface around any other.
#pragma once

#include "common/mesh/triangle_mesh.h"

namespace tacipc {

/// What a ball of radius alpha leaves when it eats away the space around a surface without coming nearer than the
/// offset [Portaneri2022]: closed, outward, every edge in two faces, no face through another, all of the surface
/// inside. Its faces are about alpha wide. Holes and grooves narrower than the ball are bridged; where it gets inside
/// an open surface, that becomes a wall of two offsets. \throw DataError if no face has an area or CGAL fails.
TriangleMesh alpha_wrap(const TriangleMesh& mesh, double alpha_m, double offset_m);

}  // namespace tacipc
