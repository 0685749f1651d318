// Exact geometric predicates: every sign is that of the exact value at the given doubles, unaffected by rounding.
#pragma once

#include <array>

#include "common/base/types.h"

namespace tacipc {

using TrianglePoints = std::array<Vector3, 3>;

/// Returns the sign (−1, 0, 1) of det[b − a, c − a, d − a], six times the signed volume of tetrahedron abcd.
/// A rounding-error filter decides most cases; arbitrary-precision integers decide the others.
/// \pre all coordinates are finite
int orient3d(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d);

/// Returns whether closed segment pq and closed triangle share a point; touching, coplanar and degenerate cases count.
bool segment_intersects_triangle(const Vector3& p, const Vector3& q, const TrianglePoints& triangle);

/// Returns whether two closed triangles share a point.
bool triangles_intersect(const TrianglePoints& first, const TrianglePoints& second);

/// Returns whether two triangles with the common edge vw share more than that edge: they are coplanar with a and b on
/// one side.
bool hinge_is_folded_flat(const Vector3& v, const Vector3& w, const Vector3& a, const Vector3& b);

/// Returns whether two triangles of one mesh share more than their common vertices. `first` and `second` are their
/// vertex indices; equal indices are the same vertex.
bool mesh_triangles_intersect(std::array<int, 3> first, TrianglePoints p, std::array<int, 3> second, TrianglePoints q);

}  // namespace tacipc
