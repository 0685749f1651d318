#include "stages/gel/press/measure/front_surface.h"

#include <algorithm>

#include "common/base/statistics.h"

namespace tacipc {

double median_front_edge_m(const TetMesh& gel) {
  std::vector<double> lengths;
  const Triangles front = gel.faces(BoundaryTag::front);
  for (Eigen::Index f = 0; f < front.rows(); ++f) {
    for (int k = 0; k < 3; ++k)
      lengths.push_back((gel.positions.row(front(f, k)) - gel.positions.row(front(f, (k + 1) % 3))).norm());
  }
  return upper_median(std::move(lengths));
}

FrontSurface make_front_surface(const TetMesh& gel) {
  FrontSurface front{.vertices = gel.vertices(BoundaryTag::front), .triangles = gel.faces(BoundaryTag::front)};
  for (Eigen::Index f = 0; f < front.triangles.rows(); ++f) {
    for (int c = 0; c < 3; ++c) {
      const auto at = std::lower_bound(front.vertices.begin(), front.vertices.end(), front.triangles(f, c));
      front.triangles(f, c) = static_cast<int>(at - front.vertices.begin());
    }
  }
  return front;
}

Positions on_front(const FrontSurface& front, const Positions& of_gel) {
  Positions rows(static_cast<Eigen::Index>(front.vertices.size()), 3);
  for (Eigen::Index v = 0; v < rows.rows(); ++v) rows.row(v) = of_gel.row(front.vertices[static_cast<std::size_t>(v)]);
  return rows;
}

std::vector<double> triangle_areas(const FrontSurface& front, const Positions& front_positions) {
  std::vector<double> areas(static_cast<std::size_t>(front.triangles.rows()));
  for (Eigen::Index f = 0; f < front.triangles.rows(); ++f) {
    const Vector3 a = front_positions.row(front.triangles(f, 0)), b = front_positions.row(front.triangles(f, 1)),
                  c = front_positions.row(front.triangles(f, 2));
    areas[static_cast<std::size_t>(f)] = 0.5 * (b - a).cross(c - a).norm();
  }
  return areas;
}

std::vector<double> lumped_areas(const FrontSurface& front, const Positions& front_positions) {
  const std::vector<double> areas = triangle_areas(front, front_positions);
  std::vector<double> lumped(front.vertices.size(), 0.0);
  for (Eigen::Index f = 0; f < front.triangles.rows(); ++f) {
    for (int c = 0; c < 3; ++c)
      lumped[static_cast<std::size_t>(front.triangles(f, c))] += areas[static_cast<std::size_t>(f)] / 3.0;
  }
  return lumped;
}

}  // namespace tacipc
