#include "stages/gel/tetmesh/statistics.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "common/base/statistics.h"
#include "stages/gel/tetmesh/face_mesh.h"
#include "stages/gel/tetmesh/mesh_check.h"
#include "stages/gel/tetmesh/sizing.h"

namespace tacipc {
namespace {

using Edges = std::vector<std::pair<int, int>>;

Edges tet_edges(const Tetrahedra& tets) {
  Edges edges;
  edges.reserve(static_cast<std::size_t>(6 * tets.rows()));
  for (Eigen::Index t = 0; t < tets.rows(); ++t)
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < i; ++j)
        edges.emplace_back(std::min(tets(t, i), tets(t, j)), std::max(tets(t, i), tets(t, j)));
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

EdgeStatistics measure(const TetMesh& mesh, const Edges& edges, double min_radius_m, double max_radius_m,
                       const std::function<double(const Vector3&)>& wanted) {
  EdgeStatistics s{.min_m = std::numeric_limits<double>::infinity()};
  for (const auto& [i, j] : edges) {
    const Vector3 p = mesh.positions.row(i), q = mesh.positions.row(j), middle = (p + q) / 2.0;
    const double radius = middle.head<2>().norm(), length = (p - q).norm();
    if (radius < min_radius_m || radius >= max_radius_m) continue;
    ++s.count;
    s.mean_m += length;
    s.min_m = std::min(s.min_m, length);
    s.max_m = std::max(s.max_m, length);
    if (wanted) s.mean_ratio += length / wanted(middle);
  }
  if (s.count == 0) return {};
  s.mean_m /= static_cast<double>(s.count);
  s.mean_ratio /= static_cast<double>(s.count);
  return s;
}

/// Rounds to four significant digits for readable records; the mesh itself has all digits.
double rounded(double value) {
  if (value == 0.0 || !std::isfinite(value)) return value;
  return std::stod(fmt::format("{:.4g}", value));
}

Value edge_lines(const EdgeStatistics& s, bool with_ratio) {
  Value::Map lines{{"edges", static_cast<std::int64_t>(s.count)}};
  if (s.count > 0) {
    lines.insert(
        lines.end(),
        {{"mean_mm", rounded(1e3 * s.mean_m)}, {"min_mm", rounded(1e3 * s.min_m)}, {"max_mm", rounded(1e3 * s.max_m)}});
    if (with_ratio) lines.emplace_back("mean_over_wanted", rounded(s.mean_ratio));
  }
  return lines;
}

Value::Map shape_lines(const TetMesh& mesh) {
  std::vector<double> smallest, radius_edge;
  double largest = 0.0, volume = 0.0;
  for (Eigen::Index t = 0; t < mesh.num_tets(); ++t) {
    const Vector3 a = mesh.positions.row(mesh.tets(t, 0)), b = mesh.positions.row(mesh.tets(t, 1)),
                  c = mesh.positions.row(mesh.tets(t, 2)), d = mesh.positions.row(mesh.tets(t, 3));
    const DihedralAngles angles = dihedral_angles(a, b, c, d);
    smallest.push_back(angles.smallest_deg);
    largest = std::max(largest, angles.largest_deg);
    const Vector3 u = b - a, v = c - a, w = d - a;
    const double six_volumes = u.dot(v.cross(w));
    volume += six_volumes / 6.0;
    // Circumradius |u² v×w + v² w×u + w² u×v| / (2 · 6V).
    const double circumradius =
        (u.squaredNorm() * v.cross(w) + v.squaredNorm() * w.cross(u) + w.squaredNorm() * u.cross(v)).norm() /
        (2.0 * six_volumes);
    const double shortest = std::min({u.norm(), v.norm(), w.norm(), (v - u).norm(), (w - u).norm(), (w - v).norm()});
    radius_edge.push_back(circumradius / shortest);
  }
  return {{"dihedral_deg", Value::Map{{"min", rounded(lower_quantile(smallest, 0.0))},
                                      {"min_1_percent", rounded(lower_quantile(smallest, 0.01))},
                                      {"max", rounded(largest)}}},
          {"radius_edge_ratio", Value::Map{{"median", rounded(lower_quantile(radius_edge, 0.5))},
                                           {"max", rounded(lower_quantile(radius_edge, 1.0))}}},
          {"volume_mm3", rounded(1e9 * volume)}};
}

Value face_lines(const TetMesh& mesh, BoundaryTag tag) {
  return Value::Map{{"vertices", mesh.vertices(tag).size()},
                    {"triangles", static_cast<std::int64_t>(mesh.faces(tag).rows())}};
}

Value::Map count_lines(const TetMesh& mesh) {
  return {{"vertices", static_cast<std::int64_t>(mesh.num_vertices())},
          {"tets", static_cast<std::int64_t>(mesh.num_tets())}};
}

}  // namespace

double analytic_volume(const GelShape& gel) {
  const bool disc = gel.outline == GelShape::Outline::disc;
  const double area = disc ? std::numbers::pi * gel.radius_m * gel.radius_m : gel.width_m * gel.height_m;
  if (!gel.dome_radius_m) return area * gel.thickness_m;
  if (disc) {
    // ∫ (R − √(R² − r²)) 2πr dr over r < a is π a² R − (2π/3)(R³ − (R² − a²)^{3/2}).
    const double R = *gel.dome_radius_m, a = gel.radius_m;
    const double sag =
        std::numbers::pi * a * a * R - 2.0 * std::numbers::pi / 3.0 * (R * R * R - std::pow(R * R - a * a, 1.5));
    return area * gel.thickness_m - sag;
  }
  constexpr int kSteps = 200;  // must be even
  const auto weight = [](int i) { return i == 0 || i == kSteps ? 1.0 : i % 2 == 1 ? 4.0 : 2.0; };
  double sum = 0.0;
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; j <= kSteps; ++j) {
      sum += weight(i) * weight(j) *
             gel.front_z(gel.width_m * (static_cast<double>(i) / kSteps - 0.5),
                         gel.height_m * (static_cast<double>(j) / kSteps - 0.5));
    }
  return area * (gel.thickness_m + sum / (9.0 * kSteps * kSteps));
}

GelEdges edge_statistics(const TetMesh& mesh, double reach_m, const std::function<double(const Vector3&)>& wanted) {
  const Edges front = unique_edges(mesh.faces(BoundaryTag::front)), back = unique_edges(mesh.faces(BoundaryTag::glued));
  const double everywhere = std::numeric_limits<double>::infinity();
  return {.all = measure(mesh, tet_edges(mesh.tets), 0.0, everywhere, wanted),
          .front_centre = measure(mesh, front, 0.0, 0.1 * reach_m, wanted),
          .front_inner = measure(mesh, front, 0.35 * reach_m, 0.43 * reach_m, wanted),
          .front_rim = measure(mesh, front, 0.85 * reach_m, everywhere, wanted),
          .back = measure(mesh, back, 0.0, everywhere, wanted)};
}

Value::Map summary(const TetMesh& mesh, double edge_m) {
  const auto wanted = [edge_m](const Vector3&) { return edge_m; };
  const double everywhere = std::numeric_limits<double>::infinity();
  const auto lines_of = [&](const Edges& edges) {
    return edge_lines(measure(mesh, edges, 0.0, everywhere, wanted), true);
  };
  Value::Map lines = count_lines(mesh);
  lines.emplace_back("free", face_lines(mesh, BoundaryTag::free));
  lines.emplace_back("edge_length", Value::Map{{"all", lines_of(tet_edges(mesh.tets))},
                                               {"surface", lines_of(unique_edges(mesh.boundary))}});
  for (auto& line : shape_lines(mesh)) lines.push_back(std::move(line));
  return lines;
}

Value::Map summary(const TetMesh& mesh, const GelShape& gel, const std::function<double(const Vector3&)>& wanted) {
  Value::Map lines = count_lines(mesh);
  for (const auto& [tag, word] : {std::pair{BoundaryTag::front, "front"}, std::pair{BoundaryTag::side, "side"},
                                  std::pair{BoundaryTag::glued, "glued"}})
    lines.emplace_back(word, face_lines(mesh, tag));
  const GelEdges edges = edge_statistics(mesh, Sizing{{}, gel}.reach_m(), wanted);
  const bool with_ratio = static_cast<bool>(wanted);
  lines.emplace_back("edge_length", Value::Map{{"all", edge_lines(edges.all, with_ratio)},
                                               {"front_centre", edge_lines(edges.front_centre, with_ratio)},
                                               {"front_inner", edge_lines(edges.front_inner, with_ratio)},
                                               {"front_rim", edge_lines(edges.front_rim, with_ratio)},
                                               {"back", edge_lines(edges.back, with_ratio)}});
  for (auto& line : shape_lines(mesh)) lines.push_back(std::move(line));
  lines.emplace_back("analytic_volume_mm3", rounded(1e9 * analytic_volume(gel)));
  return lines;
}

}  // namespace tacipc
