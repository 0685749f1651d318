#include "stages/press/contact/pair_counting.h"

#include <algorithm>

#include "stages/press/contact/sharpness.h"

namespace tacipc {
namespace {

/// Sorts and drops repetitions: the same cells in the same order, however the triangles came.
void make_unique(std::vector<std::array<int, 3>>& cells) {
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
}

}  // namespace

std::vector<ContactPair> weighted(std::vector<ContactPair> pairs, const ContactMesh& mesh,
                                  const PairCounting& counting) {
  if (!counting.once) return pairs;
  using Kind = ContactPair::Kind;
  const auto of_gel = [&](int v) { return v < mesh.num_gel_vertices; };
  std::vector<std::array<int, 3>> edges, corners;  // the vertex, then the cell's lowest and highest vertex
  for (ContactPair& pair : pairs) {
    const auto& v = pair.vertices;
    if (of_gel(v[0]) == of_gel(v[3])) continue;
    if (pair.kind == Kind::edge_edge) {
      const std::size_t edge =
          of_gel(v[0]) ? index_of_edge(mesh.object, v[2], v[3]) : index_of_edge(mesh.object, v[0], v[1]);
      pair.weight = std::max(counting.edge_weight, mesh.object_edge_sharpness[edge]);
      continue;
    }
    for (int k = 1; k <= 3; ++k) {
      const int a = v[k], b = v[k % 3 + 1];
      edges.push_back({v[0], std::min(a, b), std::max(a, b)});
      corners.push_back({v[0], a, a});
    }
  }
  make_unique(edges);
  make_unique(corners);
  for (const auto& [p, a, b] : edges) pairs.push_back({Kind::point_triangle, {p, a, b, b}, -1.0});
  for (const auto& [p, a, b] : corners) pairs.push_back({Kind::point_triangle, {p, a, b, b}, 1.0});
  return pairs;
}

}  // namespace tacipc
