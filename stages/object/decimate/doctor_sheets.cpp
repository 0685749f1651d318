// Separates edges where more than two faces meet into surfaces of two faces each.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "stages/object/decimate/doctor_steps.h"

namespace tacipc {
namespace {

using Uses = std::span<const EdgeUse>;

/// True for an edge of more than two faces.
bool crowded(Uses edge) { return edge.size() > 2; }

/// A face at an edge, seen along the edge from its lower to its higher vertex.
struct Leaf {
  int half_edge;
  double angle;
  bool forwards;  // true: it runs from the lower to the higher vertex, with the solid at smaller angles; false: at
                  // larger ones
};

std::vector<Leaf> leaves_around(const TriangleMesh& mesh, Uses edge) {
  const Vector3 from = mesh.positions.row(edge[0].low), to = mesh.positions.row(edge[0].high);
  const Vector3 along = (to - from).normalized(), u = along.unitOrthogonal(), v = along.cross(u);
  std::vector<Leaf> leaves;
  for (const auto& [low, high, half_edge] : edge) {
    const int third = target_of(mesh.triangles, next_in_face(half_edge));
    const Vector3 away = Vector3(mesh.positions.row(third)) - from;
    leaves.push_back({half_edge, std::atan2(v.dot(away), u.dot(away)), origin_of(mesh.triangles, half_edge) == low});
  }
  // Of two faces at the same angle the one with the solid below comes first: they are two touching solids, not a sheet.
  std::ranges::sort(leaves, [](const Leaf& a, const Leaf& b) {
    if (a.angle != b.angle) return a.angle < b.angle;
    return a.forwards != b.forwards ? a.forwards : a.half_edge < b.half_edge;
  });
  return leaves;
}

/// Pairs each face with its neighbour across the solid, the narrowest wedge first; faces without a partner stay open.
void pair_leaves(std::vector<Leaf> leaves, std::vector<int>& opposite) {
  for (const Leaf& leaf : leaves) opposite[leaf.half_edge] = kOpen;
  while (leaves.size() > 1) {
    std::size_t narrowest = leaves.size();
    double least = 1e300;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      const Leaf &here = leaves[i], &next = leaves[(i + 1) % leaves.size()];
      if (here.forwards || !next.forwards) continue;
      double wedge = next.angle - here.angle;
      if (wedge < 0.0) wedge += 2.0 * std::numbers::pi;
      if (wedge < least) {
        least = wedge;
        narrowest = i;
      }
    }
    if (narrowest == leaves.size()) return;
    const std::size_t other = (narrowest + 1) % leaves.size();
    pair_up(leaves[narrowest].half_edge, leaves[other].half_edge, opposite);
    leaves.erase(leaves.begin() + static_cast<std::ptrdiff_t>(std::max(narrowest, other)));
    leaves.erase(leaves.begin() + static_cast<std::ptrdiff_t>(std::min(narrowest, other)));
  }
}

/// Opposite half edges as in opposite_half_edges, with the faces of crowded edges in pairs.
std::vector<int> paired_half_edges(const TriangleMesh& mesh, Uses uses) {
  std::vector<int> opposite(uses.size(), kOpen);
  for_each_edge(uses, [&](Uses edge) {
    if (crowded(edge)) pair_leaves(leaves_around(mesh, edge), opposite);
    if (edge.size() == 2) pair_up(edge[0].half_edge, edge[1].half_edge, opposite);
  });
  return opposite;
}

/// Gives each pair of faces its own vertex in the middle of an edge if sheets share both ends of it. A face is cut once
/// per round; edges of faces that are already cut wait for the next round.
void halve_edges(TriangleMesh& mesh, Uses uses, const std::vector<int>& opposite) {
  std::vector<char> cut(mesh.num_triangles(), 0);
  std::vector<Eigen::RowVector3d> middles;
  std::vector<std::array<int, 3>> added;
  const int before = static_cast<int>(mesh.num_vertices());
  for_each_edge(uses, [&](Uses edge) {
    const auto is_cut = [&](const EdgeUse& use) { return cut[use.half_edge / 3] != 0; };
    if (!crowded(edge) || std::ranges::any_of(edge, is_cut)) return;
    const Eigen::RowVector3d middle = 0.5 * (mesh.positions.row(edge[0].low) + mesh.positions.row(edge[0].high));
    for (const EdgeUse& use : edge) {
      const int h = use.half_edge, partner = opposite[h];
      if (partner != kOpen && partner < h) continue;
      const int m = before + static_cast<int>(middles.size());
      middles.push_back(middle);
      for (const int half_edge : {h, partner}) {
        if (half_edge == kOpen) continue;
        const int face = half_edge / 3, k = half_edge % 3;
        cut[face] = 1;
        std::array<int, 3> rest{mesh.triangles(face, 0), mesh.triangles(face, 1), mesh.triangles(face, 2)};
        rest[k] = m;
        mesh.triangles(face, (k + 1) % 3) = m;
        added.push_back(rest);
      }
    }
  });
  mesh.positions.conservativeResize(before + std::ssize(middles), 3);
  mesh.positions.bottomRows(std::ssize(middles)) = rows_of<Positions>(middles);
  append_faces(mesh, added);
}

}  // namespace

void separate_sheets(TriangleMesh& mesh, DoctorReport& report) {
  constexpr int kMaxRounds = 20;
  for (int round = 0; round < kMaxRounds; ++round) {
    std::vector<EdgeUse> uses = edge_uses(mesh.triangles);
    std::int64_t count = 0;
    for_each_edge(uses, [&](Uses edge) { count += crowded(edge) ? 1 : 0; });
    if (count == 0) return;
    if (round == 0) report.separated_edges = count;
    split_fans(mesh, paired_half_edges(mesh, uses), report);
    uses = edge_uses(mesh.triangles);
    halve_edges(mesh, uses, paired_half_edges(mesh, uses));
  }
  opposite_half_edges(mesh);  // throws with the position
}

}  // namespace tacipc
