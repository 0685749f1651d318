#include "stages/gel/press/contact/surface_pairs.h"

#include "stages/gel/press/contact/search_tools.h"

namespace tacipc {
namespace {

/// Primitives whose path from x to x + p, grown by `margin`, touches a box, with a tree around them.
template <typename Primitives>
struct Near {
  std::vector<std::size_t> which;
  std::vector<Box> boxes;

  Near(const Primitives& primitives, const Positions& x, const Positions& end, double margin, const Box& within) {
    for (std::size_t i = 0; i < primitives.size(); ++i) {
      Box box = box_around(x, primitives[i]);
      box.extend(box_around(end, primitives[i]));
      box = grown(box, margin);
      if (!box.intersects(within)) continue;
      which.push_back(i);
      boxes.push_back(box);
    }
  }
};

template <typename A, typename B, typename Visit>
void for_each_touching(const Near<A>& a, const Near<B>& b, Visit&& visit) {
  if (a.boxes.empty() || b.boxes.empty()) return;
  const Bvh tree(b.boxes);
  for (std::size_t i = 0; i < a.boxes.size(); ++i)
    tree.query(a.boxes[i], [&](int j) { visit(a.which[i], b.which[static_cast<std::size_t>(j)]); });
}

}  // namespace

void pairs_between(const Surface& a, const Surface& b, const Positions& x, const Positions& p, double within_m,
                   std::vector<ContactPair>& out) {
  const Positions end = x + p;
  const double margin = 0.5 * within_m;
  const auto around = [&](const Surface& surface) {
    Box box = box_around(x, surface.vertices);
    box.extend(box_around(end, surface.vertices));
    return grown(box, margin);
  };
  const Box box_a = around(a), box_b = around(b);
  if (!box_a.intersects(box_b)) return;
  const Box both = box_a.intersection(box_b);
  const OneVertex points_a{a.vertices}, points_b{b.vertices};
  const Near near_points_a(points_a, x, end, margin, both), near_points_b(points_b, x, end, margin, both);
  const Near near_a(a.triangles, x, end, margin, both), near_b(b.triangles, x, end, margin, both);
  const Near edges_a(a.edges, x, end, margin, both), edges_b(b.edges, x, end, margin, both);
  for_each_touching(near_points_a, near_b, [&](std::size_t i, std::size_t j) {
    out.push_back(point_triangle_pair(a.vertices[i], b.triangles[j]));
  });
  for_each_touching(near_points_b, near_a, [&](std::size_t i, std::size_t j) {
    out.push_back(point_triangle_pair(b.vertices[i], a.triangles[j]));
  });
  for_each_touching(edges_a, edges_b,
                    [&](std::size_t i, std::size_t j) { out.push_back(edge_edge_pair(a.edges[i], b.edges[j])); });
}

}  // namespace tacipc
