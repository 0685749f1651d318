// Points on the surface of an object.
#pragma once

#include <cstdint>

#include "common/mesh/triangle_mesh.h"

namespace tacipc {

/// Area of a mesh, m².
double surface_area(const TriangleMesh& mesh);

/// Spreads `count` points over the surface by area: one in each of `count` pieces of equal area, which follow each
/// other in the order of the triangles. The position in a piece is random. The same mesh, count and seed give the same
/// points.
/// \throw DataError if the mesh has no area
Positions sample_surface(const TriangleMesh& mesh, int count, std::uint64_t seed);

}  // namespace tacipc
