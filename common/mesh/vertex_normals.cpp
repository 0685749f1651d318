#include "common/mesh/vertex_normals.h"

#include <cmath>

namespace tacipc {

Positions vertex_normals(const Positions& positions, const Triangles& triangles) {
  Positions normals = Positions::Zero(positions.rows(), 3);
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int corner = triangles(f, k), next = triangles(f, (k + 1) % 3), last = triangles(f, (k + 2) % 3);
      const Vector3 a = (positions.row(next) - positions.row(corner)).transpose();
      const Vector3 b = (positions.row(last) - positions.row(corner)).transpose();
      const Vector3 area = a.cross(b);
      const double twice_area = area.norm();
      if (twice_area == 0.0) continue;
      normals.row(corner) += (std::atan2(twice_area, a.dot(b)) / twice_area * area).transpose();
    }
  }
  for (Eigen::Index v = 0; v < normals.rows(); ++v) {
    const double length = normals.row(v).norm();
    if (length > 0.0) normals.row(v) /= length;
  }
  return normals;
}

}  // namespace tacipc
