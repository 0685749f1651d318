#include "stages/gel/press/contact/self_search.h"

#include <array>
#include <cmath>
#include <functional>

#include "stages/gel/press/contact/near_pairs.h"
#include "stages/gel/press/contact/search_tools.h"

namespace tacipc {
namespace {

constexpr double kMargin = 0.25;  // × d̂, around the end of the step that was searched

/// Adds the pair unless its two sides share a vertex.
void offer(const ContactPair& pair, std::vector<ContactPair>& out) {
  const auto& v = pair.vertices;
  const bool apart = pair.kind == ContactPair::Kind::point_triangle
                         ? v[0] != v[1] && v[0] != v[2] && v[0] != v[3]
                         : v[0] != v[2] && v[0] != v[3] && v[1] != v[2] && v[1] != v[3];
  if (apart) out.push_back(pair);
}

/// Boxes around some of the primitives, given those around the vertices, grown by `margin`; empty ones around those
/// that touch none of the places `within`.
template <typename Primitives>
std::vector<Box> boxes_around(const std::vector<int>& some, const Primitives& primitives, const std::vector<Box>& all,
                              double margin, const OpenFace::Places* within) {
  std::vector<Box> boxes(some.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, boxes.size(), 2048), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      Box box;
      if (within && !within->near(primitives[static_cast<std::size_t>(some[i])])) continue;
      for (const int v : primitives[static_cast<std::size_t>(some[i])]) box.extend(all[v]);
      boxes[i] = grown(box, margin);
    }
  });
  return boxes;
}

}  // namespace

SelfSearch::SelfSearch(const ContactMesh& mesh)
    : mesh_(mesh), open_face_(mesh), face_(part_of(true)), others_(part_of(false)), face_at_risk_(face_) {}

SelfSearch::Part SelfSearch::part_of(bool face) const {
  const Surface& gel = mesh_.gel;
  const auto select = [&](const auto& primitives) {
    std::vector<int> some;
    for (std::size_t i = 0; i < primitives.size(); ++i) {
      const auto& v = primitives[i];
      if (std::all_of(v.begin(), v.end(), [&](int k) { return open_face_.has(k); }) == face)
        some.push_back(static_cast<int>(i));
    }
    return some;
  };
  const auto tree = [&](const std::vector<int>& some, const auto& primitives) {
    std::vector<Box> boxes;
    for (const int i : some) boxes.push_back(box_around(mesh_.rest_positions, primitives[static_cast<std::size_t>(i)]));
    return Bvh(boxes);
  };
  const OneVertex points{gel.vertices};
  std::vector<int> vertices = select(points), edges = select(gel.edges), triangles = select(gel.triangles);
  Bvh vertex_tree = tree(vertices, points), edge_tree = tree(edges, gel.edges),
      triangle_tree = tree(triangles, gel.triangles);
  return {std::move(vertices),    std::move(edges),     std::move(triangles),
          std::move(vertex_tree), std::move(edge_tree), std::move(triangle_tree)};
}

void SelfSearch::fit(Part& part, const std::vector<Box>& boxes, double margin, const OpenFace::Places* within) const {
  part.vertex_tree.refit(boxes_around(part.vertices, OneVertex{mesh_.gel.vertices}, boxes, margin, within));
  part.edge_tree.refit(boxes_around(part.edges, mesh_.gel.edges, boxes, margin, within));
  part.triangle_tree.refit(boxes_around(part.triangles, mesh_.gel.triangles, boxes, margin, within));
}

void SelfSearch::search(const Positions& x, const Positions& p, double d_hat_m) {
  ++num_searches_;
  d_hat_m_ = d_hat_m;
  end_ = x + p;
  std::vector<Box> boxes(static_cast<std::size_t>(mesh_.num_gel_vertices));
  for (const int v : mesh_.gel.vertices) {
    boxes[v].extend(Vector3(x.row(v)));
    boxes[v].extend(grown(Box(Vector3(end_.row(v))), kMargin * d_hat_m));
  }
  // Half of d̂ on each side.
  fit(face_, boxes, 0.5 * d_hat_m);
  fit(others_, boxes, 0.5 * d_hat_m);
  if (!searched_.none()) fit(face_at_risk_, boxes, 0.5 * d_hat_m, &searched_);

  const Surface& gel = mesh_.gel;
  // The queries, each in parts that can run at the same time.
  using Query = std::function<void(int part, std::vector<ContactPair>& candidates)>;
  std::vector<Query> queries;
  const auto vertices_and_triangles = [&](const Part& a, const Part& b) {
    queries.push_back([&](int part, std::vector<ContactPair>& candidates) {
      a.vertex_tree.overlaps(b.triangle_tree, part, [&](int i, int j) {
        offer(point_triangle_pair(gel.vertices[a.vertices[i]], gel.triangles[b.triangles[j]]), candidates);
      });
    });
  };
  const auto edges = [&](const Part& a, const Part& b) {
    queries.push_back([&](int part, std::vector<ContactPair>& candidates) {
      a.edge_tree.overlaps(b.edge_tree, part, [&](int i, int j) {
        const auto [first, second] = std::minmax(a.edges[i], b.edges[j]);
        offer(edge_edge_pair(gel.edges[first], gel.edges[second]), candidates);
      });
    });
  };
  if (!searched_.none()) {
    vertices_and_triangles(face_at_risk_, face_at_risk_);
    edges(face_at_risk_, face_at_risk_);
  }
  vertices_and_triangles(face_, others_);
  vertices_and_triangles(others_, face_);
  vertices_and_triangles(others_, others_);
  edges(face_, others_);
  edges(others_, others_);

  struct Found {
    std::vector<ContactPair> pairs;
    std::vector<double> reach_m;
  };
  std::vector<Found> found(queries.size() * Bvh::kParts);
  tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t part) {
    std::vector<ContactPair> candidates;
    queries[part / Bvh::kParts](static_cast<int>(part % Bvh::kParts), candidates);
    std::vector<double> reach = coarse_squared_distances(candidates, mesh_.rest_positions);
    // Zero: edges too parallel to tell.
    for (double& r : reach) r = r > 0.0 ? std::min(d_hat_m, 0.5 * std::sqrt(r)) : d_hat_m;
    // Near during the step, or so near at its end that they could come near within the margin.
    std::vector<double> within = reach;
    for (double& w : within) w += 2.0 * kMargin * d_hat_m;
    for_each_coming_near(
        candidates, 0, candidates.size(), [&](std::size_t i) { return within[i]; }, x, p,
        [&](std::size_t i) {
          found[part].pairs.push_back(candidates[i]);
          found[part].reach_m.push_back(reach[i]);
        });
  });
  near_.clear();
  reach_m_.clear();
  for (const Found& part : found) {
    near_.insert(near_.end(), part.pairs.begin(), part.pairs.end());
    reach_m_.insert(reach_m_.end(), part.reach_m.begin(), part.reach_m.end());
  }
}

void SelfSearch::pairs(const Positions& x, const Positions& p, double d_hat_m, std::vector<ContactPair>& out) {
  OpenFace::Places at_risk = open_face_.at_risk(x, p, d_hat_m);
  bool known = d_hat_m == d_hat_m_ && at_risk.within(searched_);
  for (auto v = mesh_.gel.vertices.begin(); known && v != mesh_.gel.vertices.end(); ++v) {
    const Vector3 from_end = x.row(*v) - end_.row(*v);
    known = std::max(from_end.norm(), (from_end + p.row(*v).transpose()).norm()) <= kMargin * d_hat_m;
  }
  if (!known) {
    searched_ = std::move(at_risk);
    search(x, p, d_hat_m);
  }
  collect(near_.size(), out, [&](std::size_t first, std::size_t last, std::vector<ContactPair>& found) {
    for_each_coming_near(
        near_, first, last, [&](std::size_t i) { return reach_m_[i]; }, x, p,
        [&](std::size_t i) { found.push_back(near_[i]); });
  });
}

void SelfSearch::around(const std::vector<double>& reach_m, const Positions& x, double d_hat_m,
                        std::vector<ContactPair>& out) const {
  const Surface& gel = mesh_.gel;
  // The trees' boxes are grown by half of d̂. Of two moving parts the one that goes farther finds the other, which may
  // be or come as far from its own box.
  const auto box_of = [&](const auto& vertices, double reach) {
    return grown(box_around(x, vertices), 0.5 * d_hat_m + 2.0 * reach);
  };
  const std::array<const Part*, 2> parts{&face_, &others_};
  for (const int v : gel.vertices) {
    if (reach_m[v] == 0.0) continue;
    const Box box = box_of(std::array<int, 1>{v}, reach_m[v]);
    for (const Part* part : parts) {
      part->triangle_tree.query(box, [&](int j) {
        const auto& t = gel.triangles[part->triangles[j]];
        if (farthest_reach(reach_m, t) <= reach_m[v]) offer(point_triangle_pair(v, t), out);
      });
    }
  }
  for (const auto& t : gel.triangles) {
    const double reach = farthest_reach(reach_m, t);
    if (reach == 0.0) continue;
    const Box box = box_of(t, reach);
    for (const Part* part : parts) {
      part->vertex_tree.query(box, [&](int j) {
        const int v = gel.vertices[part->vertices[j]];
        if (reach_m[v] < reach) offer(point_triangle_pair(v, t), out);
      });
    }
  }
  for (int i = 0; i < static_cast<int>(gel.edges.size()); ++i) {
    const auto& e = gel.edges[i];
    const double reach = farthest_reach(reach_m, e);
    if (reach == 0.0) continue;
    const Box box = box_of(e, reach);
    for (const Part* part : parts) {
      part->edge_tree.query(box, [&](int k) {
        const int j = part->edges[k];
        const auto& f = gel.edges[j];
        const double other = farthest_reach(reach_m, f);
        if (other < reach || (other == reach && i < j)) offer(edge_edge_pair(e, f), out);
      });
    }
  }
}

}  // namespace tacipc
