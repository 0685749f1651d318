#include <algorithm>
#include <limits>
#include <set>

#include "common/base/error.h"
#include "stages/object/decimate/doctor_steps.h"

#include <Eigen/Geometry>

namespace tacipc {
namespace {

using Loop = std::vector<int>;

/// Vertices of each boundary loop, in the direction of a face that fills it.
std::vector<Loop> boundary_loops(const TriangleMesh& mesh, const std::vector<int>& opposite) {
  constexpr int kNone = -1;
  std::vector<int> open_from(mesh.num_vertices(), kNone);
  for (int h = 0; h < static_cast<int>(opposite.size()); ++h)
    if (opposite[h] == kOpen) open_from[origin_of(mesh.triangles, h)] = h;
  std::vector<Loop> loops;
  for (int first = 0; first < static_cast<int>(mesh.num_vertices()); ++first) {
    if (open_from[first] == kNone) continue;
    Loop loop;
    for (int v = first; open_from[v] != kNone;) {
      loop.push_back(v);
      const int h = open_from[v];
      open_from[v] = kNone;
      v = target_of(mesh.triangles, h);
    }
    std::ranges::reverse(loop);
    loops.push_back(std::move(loop));
  }
  return loops;
}

/// Triangulation of least area: best(i, j) = min over k of best(i, k) + best(k, j) + area(i, k, j). Chords that are
/// already edges of the mesh would join more than two faces, so they are not allowed. Empty if there is none.
std::vector<std::array<int, 3>> least_area_triangulation(const TriangleMesh& mesh, const Loop& loop,
                                                         const std::set<std::pair<int, int>>& edges) {
  const int n = static_cast<int>(loop.size());
  constexpr double kNotFillable = std::numeric_limits<double>::infinity();
  std::vector<double> best(n * n, 0.0);
  std::vector<int> choice(best.size(), 0);
  const auto allowed = [&](int i, int j) {
    return j - i == 1 || (i == 0 && j == n - 1) || !edges.contains(std::minmax({loop[i], loop[j]}));
  };
  for (int span = 2; span < n; ++span)
    for (int i = 0; i + span < n; ++i) {
      const int j = i + span;
      double& value = best[i * n + j];
      value = kNotFillable;
      if (!allowed(i, j)) continue;
      for (int k = i + 1; k < j; ++k) {
        const Vector3 a = mesh.positions.row(loop[i]), b = mesh.positions.row(loop[k]), c = mesh.positions.row(loop[j]);
        const double sum = best[i * n + k] + best[k * n + j] + 0.5 * (b - a).cross(c - a).norm();
        if (sum < value) value = sum, choice[i * n + j] = k;
      }
    }
  std::vector<std::array<int, 3>> faces;
  if (best[n - 1] == kNotFillable) return faces;
  std::vector<std::pair<int, int>> spans{{0, n - 1}};
  while (!spans.empty()) {
    const auto [i, j] = spans.back();
    spans.pop_back();
    if (j - i < 2) continue;
    const int k = choice[i * n + j];
    faces.push_back({loop[i], loop[k], loop[j]});
    spans.emplace_back(i, k);
    spans.emplace_back(k, j);
  }
  return faces;
}

}  // namespace

void fill_holes(TriangleMesh& mesh, const HoleLimits& limits, DoctorReport& report) {
  const std::vector<Loop> loops = boundary_loops(mesh, opposite_half_edges(mesh));
  if (loops.empty()) return;
  std::set<std::pair<int, int>> edges;
  for (const EdgeUse& use : edge_uses(mesh.triangles)) edges.emplace(use.low, use.high);
  std::vector<std::array<int, 3>> patch;
  for (const Loop& loop : loops) {
    double length = 0.0;
    Eigen::RowVector3d middle = Eigen::RowVector3d::Zero();
    for (std::size_t i = 0; i < loop.size(); ++i) {
      length += (mesh.positions.row(loop[(i + 1) % loop.size()]) - mesh.positions.row(loop[i])).norm();
      middle += mesh.positions.row(loop[i]) / static_cast<double>(loop.size());
    }
    const std::string hole =
        fmt::format("boundary loop of {} edges, length {:.4g} mm near {}", loop.size(), 1e3 * length, place_mm(middle));
    const bool too_large = std::ssize(loop) > limits.max_edges || length > limits.max_length_m;
    if (too_large && limits.leave_larger) continue;
    if (too_large)
      throw DataError("open mesh: {} (holes of at most {} edges and {:.4g} mm are filled)", hole, limits.max_edges,
                      1e3 * limits.max_length_m);
    const auto faces = least_area_triangulation(mesh, loop, edges);
    if (faces.empty()) throw DataError("open mesh: {} cannot be filled: its vertices are joined already", hole);
    patch.insert(patch.end(), faces.begin(), faces.end());
    ++report.filled_holes;
  }
  append_faces(mesh, patch);
  report.hole_faces += std::ssize(patch);
}

void thicken_open_parts(TriangleMesh& mesh, double thickness_m, DoctorReport& report) {
  const std::vector<int> opposite = opposite_half_edges(mesh);
  const Components components = connected_components(mesh.triangles, opposite);
  std::vector<char> open(components.count, 0);
  for (std::size_t h = 0; h < opposite.size(); ++h)
    if (opposite[h] == kOpen) open[components.of_face[h / 3]] = 1;
  report.thickened_sheets = std::ranges::count(open, 1);
  if (report.thickened_sheets == 0) return;

  Positions normals = Positions::Zero(mesh.num_vertices(), 3);
  std::vector<int> behind(mesh.num_vertices(), 0);
  const auto is_open = [&](int f) { return open[components.of_face[f]] != 0; };
  const int num_faces = static_cast<int>(mesh.num_triangles());
  for (int f = 0; f < num_faces; ++f)
    for (int k = 0; is_open(f) && k < 3; ++k)
      normals.row(mesh.triangles(f, k)) += area_vector(mesh, f).transpose(), behind[mesh.triangles(f, k)] = 1;
  auto count = static_cast<int>(mesh.num_vertices());
  for (int& vertex : behind) vertex = vertex != 0 ? count++ : -1;
  const Eigen::Index in_front = mesh.num_vertices();
  mesh.positions.conservativeResize(count, 3);
  for (Eigen::Index v = 0; v < in_front; ++v) {
    if (behind[v] < 0) continue;
    const Eigen::RowVector3d half = 0.5 * thickness_m * normals.row(v).normalized();
    mesh.positions.row(behind[v]) = mesh.positions.row(v) - half;
    mesh.positions.row(v) += half;
  }
  std::vector<std::array<int, 3>> added;
  for (int f = 0; f < num_faces; ++f) {
    if (!is_open(f)) continue;
    const auto corner_behind = [&](int k) { return behind[mesh.triangles(f, k)]; };
    added.push_back({corner_behind(0), corner_behind(2), corner_behind(1)});
    for (int k = 0; k < 3; ++k) {
      if (opposite[3 * f + k] != kOpen) continue;
      const int from = mesh.triangles(f, k), to = mesh.triangles(f, (k + 1) % 3);
      added.push_back({to, from, behind[from]});
      added.push_back({to, behind[from], behind[to]});
    }
  }
  append_faces(mesh, added);
}

}  // namespace tacipc
