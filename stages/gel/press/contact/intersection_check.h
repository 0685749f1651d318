// An independent check of finished states: exact, and sharing no code with the solver's broad phase or distances.
#pragma once

#include <cstdint>
#include <vector>

#include "common/base/types.h"

namespace tacipc {

/// Triangles over positions that may hold other vertices too (the inside of a gel).
struct SurfaceView {
  const Positions& positions;
  const Triangles& triangles;
};

struct TrianglePair {
  int first;
  int second;
  friend bool operator==(const TrianglePair&, const TrianglePair&) = default;
};

struct IntersectionReport {
  std::int64_t gel_object = 0;                    // intersecting pairs (gel triangle, object triangle)
  std::int64_t gel_gel = 0;                       // intersecting pairs of gel triangles
  std::vector<TrianglePair> gel_object_examples;  // the first pairs in ascending order
  std::vector<TrianglePair> gel_gel_examples;     // first < second

  bool none() const { return gel_object == 0 && gel_gel == 0; }
};

/// Every pair of triangles that share a point, decided exactly; touching counts. Gel triangles with common vertices
/// intersect only where they share more than those vertices or the common edge.
/// \param gel_with_itself false: pairs of two gel triangles are left out
/// \throw DataError if a vertex is not finite or an index is out of range.
IntersectionReport find_intersections(const SurfaceView& gel, const SurfaceView& object, std::size_t max_examples = 8,
                                      bool gel_with_itself = true);

/// How many times a closed surface winds around a point [Van Oosterom and Strackee 1983: solid angles of triangles]: 1
/// inside a surface that looks outwards, 0 outside, to rounding.
double winding_number(const Vector3& point, const SurfaceView& surface);

/// Tetrahedra whose exact volume det[x1 − x0, x2 − x0, x3 − x0] / 6 is not positive.
/// \throw DataError as above.
std::int64_t count_inverted_tets(const Positions& positions, const Tetrahedra& tets);

}  // namespace tacipc
