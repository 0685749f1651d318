#include "common/mesh/surface_distance.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "common/mesh/height_field.h"
#include "common/mesh/triangle_tree.h"

namespace tacipc {

Matrix3 view_of_side(const std::string& side) {
  const int axis = side[1] - 'x';
  const double sign = side[0] == '-' ? -1.0 : 1.0;
  Matrix3 view = Matrix3::Zero();
  view(0, (axis + 1) % 3) = 1.0;
  view(1, (axis + 2) % 3) = sign;
  view(2, axis) = sign;
  return view;
}

std::vector<Vector3> seen_points(const TriangleMesh& mesh, double spacing_m) {
  const HeightField field = highest_points(mesh, spacing_m, 0.0);
  std::vector<Vector3> points;
  for (int j = 0; j < field.rows; ++j)
    for (int i = 0; i < field.columns; ++i)
      if (field.at(i, j) != HeightField::kNothing)
        points.emplace_back(field.x0 + i * spacing_m, field.y0 + j * spacing_m, field.at(i, j));
  return points;
}

SurfaceDistance distance_from(const TriangleMesh& surface, const std::vector<Vector3>& points) {
  const TriangleTree tree(surface);
  std::vector<double> distance(points.size());
  tbb::parallel_for(std::size_t{0}, points.size(),
                    [&](std::size_t i) { distance[i] = std::sqrt(tree.squared_distance(points[i])); });
  SurfaceDistance found;
  for (const double d : distance) {
    found.max_m = std::max(found.max_m, d);
    found.mean_m += d;
  }
  found.mean_m /= static_cast<double>(std::max<std::size_t>(points.size(), 1));
  return found;
}

}  // namespace tacipc
