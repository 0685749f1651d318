#include "stages/robot/robot/pad_gap.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <vector>

namespace tacipc {
namespace {

/// Clips a polygon to one side of a line: sign · p[axis] ≤ limit.
std::vector<Vector3> clipped(const std::vector<Vector3>& polygon, int axis, double sign, double limit) {
  std::vector<Vector3> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double at_a = limit - sign * a[axis], at_b = limit - sign * b[axis];
    if (at_a >= 0.0) kept.push_back(a);
    if ((at_a < 0.0) != (at_b < 0.0)) kept.push_back(a + at_a / (at_a - at_b) * (b - a));
  }
  return kept;
}

// Largest z component of a facet's unit normal in S: excludes a floor next to the gel that extends behind its front.
constexpr double kLooksAt = -0.17;

}  // namespace

double gap_before(const TriangleMesh& surface, const Matrix4& gel_from_surface, double radius_m) {
  const Matrix3 R = gel_from_surface.topLeftCorner<3, 3>();
  const Vector3 t = gel_from_surface.topRightCorner<3, 1>();
  double lowest = std::numeric_limits<double>::infinity();
  for (Eigen::Index f = 0; f < surface.num_triangles(); ++f) {
    std::vector<Vector3> polygon;
    for (int k = 0; k < 3; ++k) polygon.push_back(R * Vector3(surface.positions.row(surface.triangles(f, k))) + t);
    const Vector3 normal = (polygon[1] - polygon[0]).cross(polygon[2] - polygon[0]);
    if (normal.z() > kLooksAt * normal.norm()) continue;
    for (const int axis : {0, 1}) {
      for (const double sign : {1.0, -1.0}) polygon = clipped(polygon, axis, sign, radius_m);
    }
    polygon = clipped(polygon, 2, -1.0, radius_m);
    for (const Vector3& corner : polygon) lowest = std::min(lowest, corner.z());
  }
  return lowest;
}

}  // namespace tacipc
