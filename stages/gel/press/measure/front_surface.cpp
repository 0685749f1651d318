#include "stages/gel/press/measure/front_surface.h"

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
  return {.vertices = gel.vertices(BoundaryTag::front), .triangles = gel.surface(BoundaryTag::front)};
}

Positions on_front(const FrontSurface& front, const Positions& of_gel) { return of_gel(front.vertices, Eigen::all); }

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
