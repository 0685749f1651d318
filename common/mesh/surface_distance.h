// How far a surface is from what is seen of another one.
#pragma once

#include <string>
#include <vector>

#include "common/mesh/triangle_mesh.h"

namespace tacipc {

/// Rows: where x, y and z of the view of a side (+x -x +y -y +z -z) lie in the mesh; z looks out of the side.
Matrix3 view_of_side(const std::string& side);

/// What is seen of a mesh along −z: its highest points on a grid, row by row.
std::vector<Vector3> seen_points(const TriangleMesh& mesh, double spacing_m);

struct SurfaceDistance {
  double mean_m = 0.0;
  double max_m = 0.0;
};

/// Distances of points from a surface; the same on any number of threads. \pre the surface has a triangle.
SurfaceDistance distance_from(const TriangleMesh& surface, const std::vector<Vector3>& points);

}  // namespace tacipc
