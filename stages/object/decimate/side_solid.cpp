#include "stages/object/decimate/side_solid.h"

#include <algorithm>
#include <array>
#include <vector>

#include "common/base/error.h"
#include "common/mesh/height_field.h"
#include "common/mesh/surface_distance.h"
#include "stages/object/decimate/surface_topology.h"

namespace tacipc {
namespace {

constexpr double kLargestGrid = 600.0;  // points along the longer side
constexpr double kProbes = 400.0;       // probes of the error along the longer side
constexpr double kLeastThickness =
    0.05;  // thickness of the back below the lowest visible point, as a fraction of the longer side

/// Triangles between the grid points that have a height, with the indices of `point`.
Triangles faces_between(const HeightField& field, const std::vector<int>& point) {
  std::vector<std::array<int, 3>> faces;
  for (int j = 0; j + 1 < field.rows; ++j) {
    for (int i = 0; i + 1 < field.columns; ++i) {
      const int at = j * field.columns + i;
      const std::array<int, 4> around{point[at], point[at + 1], point[at + field.columns + 1],
                                      point[at + field.columns]};
      const auto missing = std::ranges::count(around, -1);
      if (missing == 0) {
        faces.push_back({around[0], around[1], around[2]});
        faces.push_back({around[0], around[2], around[3]});
      } else if (missing == 1) {
        const auto gap = static_cast<std::size_t>(std::ranges::find(around, -1) - around.begin());
        faces.push_back({around[(gap + 1) % 4], around[(gap + 2) % 4], around[(gap + 3) % 4]});
      }
    }
  }
  return rows_of<Triangles>(faces);
}

/// Solid from the front, its mirror image on the back, and walls between their outlines.
TriangleMesh with_back(const TriangleMesh& front, double back_z) {
  const auto n = static_cast<int>(front.num_vertices());
  TriangleMesh solid;
  solid.positions.resize(2 * n, 3);
  solid.positions.topRows(n) = front.positions;
  solid.positions.bottomRows(n) = front.positions;
  solid.positions.bottomRows(n).col(2).setConstant(back_z);
  std::vector<int> outline;
  const std::vector<int> opposite = opposite_half_edges(front);
  for (int h = 0; h < static_cast<int>(opposite.size()); ++h)
    if (opposite[h] == kOpen) outline.push_back(h);
  const Eigen::Index faces = front.num_triangles();
  solid.triangles.resize(2 * faces + 2 * std::ssize(outline), 3);
  for (Eigen::Index f = 0; f < faces; ++f) {
    solid.triangles.row(f) = front.triangles.row(f);
    solid.triangles.row(faces + f) << n + front.triangles(f, 0), n + front.triangles(f, 2), n + front.triangles(f, 1);
  }
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const int a = origin_of(front.triangles, outline[i]), b = target_of(front.triangles, outline[i]);
    const Eigen::Index row = 2 * faces + 2 * static_cast<Eigen::Index>(i);
    solid.triangles.row(row) << a, n + b, b;
    solid.triangles.row(row + 1) << a, n + a, n + b;
  }
  return solid;
}

}  // namespace

TriangleMesh solid_of_side(const TriangleMesh& mesh, const std::string& side, double wanted_spacing_m,
                           SideError& error) {
  const Matrix3 view = view_of_side(side);
  TriangleMesh seen = mesh;
  seen.positions = mesh.positions * view.transpose();
  const Eigen::RowVector3d low = seen.positions.colwise().minCoeff(), high = seen.positions.colwise().maxCoeff();
  const double longer = (high - low).head<2>().maxCoeff();
  const double spacing_m = std::max(wanted_spacing_m, longer / kLargestGrid);
  const HeightField field = highest_points(seen, spacing_m, 0.0);
  std::vector<int> point(field.z.size(), -1);
  int count = 0;
  for (std::size_t i = 0; i < point.size(); ++i)
    if (field.z[i] != HeightField::kNothing) point[i] = count++;
  TriangleMesh front;
  front.positions.resize(count, 3);
  double lowest = high.z();
  for (std::size_t i = 0; i < point.size(); ++i) {
    if (point[i] < 0) continue;
    const auto column = static_cast<int>(i) % field.columns, row = static_cast<int>(i) / field.columns;
    front.positions.row(point[i]) << field.x0 + column * spacing_m, field.y0 + row * spacing_m, field.z[i];
    lowest = std::min(lowest, field.z[i]);
  }
  front.triangles = faces_between(field, point);
  if (front.num_triangles() == 0)
    throw DataError("nothing wider than {:.3g} mm is seen of the mesh from its side {}", 1e3 * spacing_m, side);
  TriangleMesh solid = with_back(front, std::min(low.z(), lowest - kLeastThickness * longer));
  // Probes avoid the grid points, where the solid is exact.
  constexpr double kBetween = 0.73;
  const SurfaceDistance distance =
      distance_from(solid, seen_points(seen, std::max(kBetween * spacing_m, longer / kProbes)));
  error = {.spacing_m = spacing_m, .mean_m = distance.mean_m, .max_m = distance.max_m};
  solid.positions *= view;
  return solid;
}

}  // namespace tacipc
