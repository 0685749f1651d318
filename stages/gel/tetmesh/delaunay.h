// Delaunay triangulation in the plane, exact: decisions are made with integers on a fine grid.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/base/types.h"

namespace tacipc {

using Vector2 = Eigen::Vector2d;

/// Delaunay triangulation of the convex hull of distinct points, counter-clockwise triangles. Points are rounded to a
/// grid of 2⁻²⁸ of their extent, on which every decision is exact: collinear and cocircular points are no special case,
/// and points on a straight side of the hull all become hull vertices. Method: incremental insertion with one ghost
/// vertex at infinity (Bowyer 1981, Watson 1981; ghosts as in Guibas and Stolfi).
/// \throw DataError if two points coincide on that grid or all lie on one line
Triangles delaunay(const std::vector<Vector2>& points);

}  // namespace tacipc
