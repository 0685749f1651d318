// An independent check of finished states: exact, and sharing no code with the solver's broad phase or distances.
#pragma once

#include <cstdint>

#include "common/base/types.h"

namespace tacipc {

/// Triangles over positions that may hold other vertices too (the inside of a gel).
struct SurfaceView {
  const Positions& positions;
  const Triangles& triangles;
};

/// Pairs of a triangle of either surface that share a point, decided exactly; touching counts.
/// \throw DataError if a vertex is not finite or an index is out of range.
std::int64_t count_intersections(const SurfaceView& gel, const SurfaceView& object);

/// The same of two triangles of one surface. Those with common vertices intersect only where they share more than those
/// vertices or the common edge.
std::int64_t count_self_intersections(const SurfaceView& gel);

/// How many times a closed surface winds around a point [Van Oosterom and Strackee 1983: solid angles of triangles]: 1
/// inside a surface that looks outwards, 0 outside, to rounding.
double winding_number(const Vector3& point, const SurfaceView& surface);

/// Tetrahedra whose exact volume det[x1 − x0, x2 − x0, x3 − x0] / 6 is not positive.
/// \throw DataError as above.
std::int64_t count_inverted_tets(const Positions& positions, const Tetrahedra& tets);

}  // namespace tacipc
