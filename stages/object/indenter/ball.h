// A ball as a triangle mesh.
#pragma once

#include "common/mesh/triangle_mesh.h"

namespace tacipc {

/// Icosahedron whose triangles are split in four until no edge is longer than `edge_m`, vertices on the sphere about
/// the origin: closed, outward. \throw DataError if that takes more than 8 splits
TriangleMesh ball_mesh(double radius_m, double edge_m);

}  // namespace tacipc
