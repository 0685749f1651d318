// Geometric decisions that rounding cannot change: every sign is that of the exact value at the given doubles.
#pragma once

#include <array>

#include "common/base/types.h"

namespace tacipc {

using TrianglePoints = std::array<Vector3, 3>;

/// Sign (−1, 0, 1) of det[b − a, c − a, d − a], six times the signed volume of tetrahedron abcd.
/// A rounding-error filter decides most cases, integers of any length the others. \pre all coordinates are finite
int orient3d(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d);

/// Whether closed segment pq and closed triangle share a point: touching, coplanar and degenerate cases included.
bool segment_intersects_triangle(const Vector3& p, const Vector3& q, const TrianglePoints& triangle);

/// Whether two closed triangles share a point.
bool triangles_intersect(const TrianglePoints& first, const TrianglePoints& second);

/// Whether two triangles with the common edge vw share more than that edge: they are coplanar with a and b on one side.
bool hinge_is_folded_flat(const Vector3& v, const Vector3& w, const Vector3& a, const Vector3& b);

/// Whether two triangles of one mesh share more than the vertices that they have in common, which `first` and `second`
/// name: two are the same vertex where their numbers are.
bool mesh_triangles_intersect(std::array<int, 3> first, TrianglePoints p, std::array<int, 3> second, TrianglePoints q);

}  // namespace tacipc
