// A ball as a triangle mesh.
#pragma once

#include "common/mesh/triangle_mesh.h"

namespace tacipc {

/// Ball as an icosahedron whose triangles are split into four until no edge is longer than `edge_m`. Vertices lie on
/// the sphere around the origin; the mesh is closed and outward.
/// \throw DataError if that takes more than 8 splits
TriangleMesh ball_mesh(double radius_m, double edge_m);

}  // namespace tacipc
