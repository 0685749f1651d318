// Independent check of finished states: exact, and without code of the solver's broad phase or distances.
#pragma once

#include <cstdint>

#include "common/base/types.h"

namespace tacipc {

/// Triangles over positions, which may also have other vertices (the inside of a gel).
struct SurfaceView {
  const Positions& positions;
  const Triangles& triangles;
};

/// Number of pairs of a triangle of either surface that share a point, decided exactly; touching counts.
/// \throw DataError if a vertex is not finite or an index is out of range
std::int64_t count_intersections(const SurfaceView& gel, const SurfaceView& object);

/// Number of intersecting pairs of triangles of one surface. Triangles with common vertices intersect only if they
/// share more than those vertices or the common edge.
std::int64_t count_self_intersections(const SurfaceView& gel);

/// Winding number of a closed surface around a point [Van Oosterom and Strackee 1983: solid angles of triangles]: 1
/// inside a surface that faces outwards, 0 outside, to rounding.
double winding_number(const Vector3& point, const SurfaceView& surface);

/// Number of tetrahedra whose exact volume det[x1 − x0, x2 − x0, x3 − x0] / 6 is not positive.
/// \throw DataError if a vertex is not finite or an index is out of range
std::int64_t count_inverted_tets(const Positions& positions, const Tetrahedra& tets);

}  // namespace tacipc
