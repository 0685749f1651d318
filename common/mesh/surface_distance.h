// Distance of a surface from the visible points of another one.
#pragma once

#include <string>
#include <vector>

#include "common/mesh/triangle_mesh.h"

namespace tacipc {

/// Returns a rotation whose rows are the view's x, y and z axes in the mesh's frame, for a side (+x -x +y -y +z -z); z
/// points out of the side.
Matrix3 view_of_side(const std::string& side);

/// Returns the visible points of a mesh along −z: its highest points on a grid, row by row.
std::vector<Vector3> seen_points(const TriangleMesh& mesh, double spacing_m);

/// Mean and largest distance over all points.
struct SurfaceDistance {
  double mean_m = 0.0;
  double max_m = 0.0;
};

/// Computes distances of points from a surface; the result does not depend on the number of threads.
/// \pre the surface has a triangle
SurfaceDistance distance_from(const TriangleMesh& surface, const std::vector<Vector3>& points);

}  // namespace tacipc
