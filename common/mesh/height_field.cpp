#include "common/mesh/height_field.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace tacipc {

HeightField highest_points(const TriangleMesh& mesh, double spacing_m, double margin_m) {
  const Eigen::RowVector3d low = mesh.positions.colwise().minCoeff(), high = mesh.positions.colwise().maxCoeff();
  const auto count = [&](int axis) {
    return 2 * static_cast<int>(std::ceil((0.5 * (high[axis] - low[axis]) + margin_m) / spacing_m)) + 1;
  };
  HeightField field{.columns = count(0), .rows = count(1), .spacing = spacing_m, .z = {}};
  field.x0 = 0.5 * (low[0] + high[0]) - 0.5 * (field.columns - 1) * spacing_m;
  field.y0 = 0.5 * (low[1] + high[1]) - 0.5 * (field.rows - 1) * spacing_m;
  field.z.assign(static_cast<std::size_t>(field.columns) * field.rows, HeightField::kNothing);
  constexpr double kEdgeSlack = 1e-6;
  for (Eigen::Index t = 0; t < mesh.num_triangles(); ++t) {
    std::array<Vector3, 3> p;
    for (int k = 0; k < 3; ++k) p[k] = mesh.positions.row(mesh.triangles(t, k));
    const double area = (p[1] - p[0]).cross(p[2] - p[0]).z();
    const double longest =
        std::max({(p[1] - p[0]).head<2>().norm(), (p[2] - p[1]).head<2>().norm(), (p[0] - p[2]).head<2>().norm()});
    if (std::abs(area) <= 1e-9 * longest * longest) continue;  // vertical triangles: their edges belong to others
    const auto [left, right] = std::minmax({p[0].x(), p[1].x(), p[2].x()});
    const auto [bottom, top] = std::minmax({p[0].y(), p[1].y(), p[2].y()});
    const auto first = [&](double at, double start) {
      return std::max(0, static_cast<int>(std::floor((at - start) / spacing_m)));
    };
    const auto last = [&](double at, double start, int n) {
      return std::min(n - 1, static_cast<int>(std::ceil((at - start) / spacing_m)));
    };
    for (int j = first(bottom, field.y0); j <= last(top, field.y0, field.rows); ++j) {
      for (int i = first(left, field.x0); i <= last(right, field.x0, field.columns); ++i) {
        const Vector3 q(field.x0 + i * spacing_m, field.y0 + j * spacing_m, 0.0);
        double z = 0.0;
        bool inside = true;
        for (std::size_t k = 0; k < 3; ++k) {
          const Vector3 &a = p[(k + 1) % 3], &b = p[(k + 2) % 3];
          const double part = ((b - a).x() * (q - a).y() - (b - a).y() * (q - a).x()) / area;
          // `part` is the distance from the edge times its length.
          inside = inside && part >= -kEdgeSlack * (b - a).head<2>().norm() / std::abs(area);
          z += part * p[k].z();
        }
        // Next to a steep triangle its plane is far above or below the triangle.
        const auto [lowest, highest] = std::minmax({p[0].z(), p[1].z(), p[2].z()});
        if (inside) field.at(i, j) = std::max(field.at(i, j), std::clamp(z, lowest, highest));
      }
    }
  }
  return field;
}

}  // namespace tacipc
