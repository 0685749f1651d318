#include "stages/gel/press/contact/self_search.h"

#include <array>
#include <cmath>

#include "stages/gel/press/contact/near_pairs.h"
#include "stages/gel/press/contact/search_tools.h"

namespace tacipc {
namespace {

// Margins around the searched positions: × the search distance, × the mean edge and, on the face, × the distance from
// its rim at rest. Pairs within the face have the first margin only, boxes of around() the second, all other pairs all
// three.
constexpr double kMargin = 0.25, kMarginOfEdge = 0.05, kMarginOfDistance = 0.25;
constexpr std::size_t kParts = 16;  // number of parts of a query

/// Adds the pair unless its two sides share a vertex.
void offer(const ContactPair& pair, std::vector<ContactPair>& out) {
  const auto& v = pair.vertices;
  const bool apart = pair.kind == ContactPair::Kind::point_triangle
                         ? v[0] != v[1] && v[0] != v[2] && v[0] != v[3]
                         : v[0] != v[2] && v[0] != v[3] && v[1] != v[2] && v[1] != v[3];
  if (apart) out.push_back(pair);
}

/// Boxes around some of the primitives, grown by `margin`, from the boxes of the vertices.
template <typename Primitives>
std::vector<Box> boxes_around(const std::vector<int>& some, const Primitives& primitives, const std::vector<Box>& all,
                              double margin) {
  std::vector<Box> boxes(some.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, boxes.size(), 2048), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      Box box;
      for (const int v : primitives[static_cast<std::size_t>(some[i])]) box.extend(all[v]);
      boxes[i] = grown(box, margin);
    }
  });
  return boxes;
}

/// Calls visit(i, j) for overlaps of two trees, in part `part` of kParts.
template <typename Visit>
void visit_part(const Bvh& a, const Bvh& b, const Bvh::NodePairs& nodes, std::size_t part, Visit&& visit) {
  a.overlaps(b, nodes, nodes.size() * part / kParts, nodes.size() * (part + 1) / kParts, visit);
}

}  // namespace

SelfSearch::SelfSearch(const ContactMesh& mesh)
    : mesh_(mesh), open_face_(mesh), face_(part_of(true)), others_(part_of(false)) {
  const Surface& gel = mesh.gel;
  const OneVertex points{gel.vertices};
  for (const int i : face_.vertices)
    squares_of_vertex_.push_back(open_face_.squares_around(points[static_cast<std::size_t>(i)]));
  for (const int i : face_.edges)
    squares_of_edge_.push_back(open_face_.squares_around(gel.edges[static_cast<std::size_t>(i)]));
  for (const int i : face_.triangles)
    squares_of_triangle_.push_back(open_face_.squares_around(gel.triangles[static_cast<std::size_t>(i)]));

  const Positions& rest = mesh.rest_positions;
  double edges_m = 0.0;
  for (const auto& e : gel.edges) edges_m += (rest.row(e[1]) - rest.row(e[0])).norm();
  margin_m_ = kMarginOfEdge * edges_m / static_cast<double>(std::max<std::size_t>(1, gel.edges.size()));
  margin_of_others_m_.assign(static_cast<std::size_t>(mesh.num_gel_vertices), margin_m_);
  // Other surfaces are beyond the rim, or below by the gel's thickness.
  std::vector<bool> on_rim(static_cast<std::size_t>(mesh.num_gel_vertices), false);
  std::vector<int> rim;
  for (const int i : others_.triangles) {
    for (const int v : gel.triangles[static_cast<std::size_t>(i)]) {
      if (!open_face_.has(v) || on_rim[v]) continue;
      on_rim[v] = true;
      rim.push_back(v);
    }
  }
  const auto heights = rest.topRows(mesh.num_gel_vertices).col(2);
  const double thickness = heights.maxCoeff() - heights.minCoeff();
  for (const int i : face_.vertices) {
    const int v = gel.vertices[i];
    double squared = thickness * thickness;
    for (const int r : rim) squared = std::min(squared, (rest.row(v) - rest.row(r)).squaredNorm());
    margin_of_others_m_[v] += kMarginOfDistance * std::sqrt(squared);
  }
}

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
  const Positions& rest = mesh_.rest_positions;
  return make_part(select(OneVertex{gel.vertices}), select(gel.edges), select(gel.triangles),
                   boxes_of(gel.vertices, rest, Positions::Zero(rest.rows(), 3), {}), 0.0);
}

SelfSearch::Part SelfSearch::make_part(std::vector<int> vertices, std::vector<int> edges, std::vector<int> triangles,
                                       const std::vector<Box>& boxes, double margin) const {
  Bvh vertex_tree(boxes_around(vertices, OneVertex{mesh_.gel.vertices}, boxes, margin)),
      edge_tree(boxes_around(edges, mesh_.gel.edges, boxes, margin)),
      triangle_tree(boxes_around(triangles, mesh_.gel.triangles, boxes, margin));
  return {std::move(vertices),    std::move(edges),     std::move(triangles),
          std::move(vertex_tree), std::move(edge_tree), std::move(triangle_tree)};
}

void SelfSearch::fit(Part& part, const std::vector<Box>& boxes, double margin) const {
  part.vertex_tree.refit(boxes_around(part.vertices, OneVertex{mesh_.gel.vertices}, boxes, margin));
  part.edge_tree.refit(boxes_around(part.edges, mesh_.gel.edges, boxes, margin));
  part.triangle_tree.refit(boxes_around(part.triangles, mesh_.gel.triangles, boxes, margin));
}

std::vector<Box> SelfSearch::boxes_of(const std::vector<int>& vertices, const Positions& x, const Positions& p,
                                      const std::vector<double>& margin_m) const {
  std::vector<Box> boxes(static_cast<std::size_t>(mesh_.num_gel_vertices));
  for (const int v : vertices) {
    boxes[v].extend(Vector3(x.row(v)));
    boxes[v].extend(grown(Box(Vector3(x.row(v) + p.row(v))), margin_m.empty() ? 0.0 : margin_m[v]));
  }
  return boxes;
}

SelfSearch::Query SelfSearch::vertices_and_triangles(const Part& a, const Part& b) const {
  return [&, this, nodes = a.vertex_tree.split(b.triangle_tree)](std::size_t part, std::vector<ContactPair>& found) {
    const Surface& gel = mesh_.gel;
    visit_part(a.vertex_tree, b.triangle_tree, nodes, part, [&](int i, int j) {
      offer(point_triangle_pair(gel.vertices[a.vertices[i]], gel.triangles[b.triangles[j]]), found);
    });
  };
}

SelfSearch::Query SelfSearch::edges(const Part& a, const Part& b) const {
  return [&, this, nodes = a.edge_tree.split(b.edge_tree)](std::size_t part, std::vector<ContactPair>& found) {
    const Surface& gel = mesh_.gel;
    visit_part(a.edge_tree, b.edge_tree, nodes, part, [&](int i, int j) {
      const auto [first, second] = std::minmax(a.edges[i], b.edges[j]);
      offer(edge_edge_pair(gel.edges[first], gel.edges[second]), found);
    });
  };
}

void SelfSearch::search_face(const Positions& x, const Positions& p) {
  of_face_.margin_m.assign(static_cast<std::size_t>(mesh_.num_gel_vertices), kMargin * *within_m_);
  of_face_.vertices.clear();
  if (searched_.none()) return find({}, x, p, of_face_);
  const auto at_risk = [&](const std::vector<int>& all, const std::vector<OpenFace::Squares>& squares) {
    std::vector<int> some;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (searched_.near(squares[i])) some.push_back(all[i]);
    }
    return some;
  };
  std::vector<int> triangles = at_risk(face_.triangles, squares_of_triangle_);
  // Vertices and edges are contained in triangles, so triangle boxes suffice.
  std::vector<bool> has(static_cast<std::size_t>(mesh_.num_gel_vertices), false);
  for (const int i : triangles) {
    for (const int v : mesh_.gel.triangles[static_cast<std::size_t>(i)]) has[v] = true;
  }
  for (const int v : mesh_.gel.vertices) {
    if (has[v]) of_face_.vertices.push_back(v);
  }
  // Half of the search distance on each side.
  const Part part =
      make_part(at_risk(face_.vertices, squares_of_vertex_), at_risk(face_.edges, squares_of_edge_),
                std::move(triangles), boxes_of(of_face_.vertices, x, p, of_face_.margin_m), 0.5 * *within_m_);
  find({vertices_and_triangles(part, part), edges(part, part)}, x, p, of_face_);
}

void SelfSearch::search_others(const Positions& x, const Positions& p) {
  of_others_.vertices = mesh_.gel.vertices;
  of_others_.margin_m = margin_of_others_m_;
  for (double& margin : of_others_.margin_m) margin += kMargin * *within_m_;
  fitted_.resize(0, 3);
  const std::vector<Box> boxes = boxes_of(mesh_.gel.vertices, x, p, of_others_.margin_m);
  fit(face_, boxes, 0.5 * *within_m_);
  fit(others_, boxes, 0.5 * *within_m_);
  find({vertices_and_triangles(face_, others_), vertices_and_triangles(others_, face_),
        vertices_and_triangles(others_, others_), edges(face_, others_), edges(others_, others_)},
       x, p, of_others_);
}

void SelfSearch::find(const std::vector<Query>& queries, const Positions& x, const Positions& p, Found& out) const {
  struct OfPart {
    std::vector<ContactPair> pairs;
    std::vector<double> reach_m;
  };
  std::vector<OfPart> found(queries.size() * kParts);
  const double within_m = *within_m_;
  tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t part) {
    std::vector<ContactPair> candidates;
    queries[part / kParts](part % kParts, candidates);
    std::vector<double> reach = coarse_squared_distances(candidates, mesh_.rest_positions);
    // Zero: edges too parallel to decide.
    for (double& r : reach) r = r > 0.0 ? std::min(within_m, 0.5 * std::sqrt(r)) : within_m;
    // Pairs that are near during the step, or so near at its end that they could come near within the margins.
    std::vector<double> within = reach;
    for (std::size_t i = 0; i < within.size(); ++i)
      within[i] += 2.0 * farthest_reach(out.margin_m, candidates[i].vertices);
    for_each_coming_near(
        candidates, 0, candidates.size(), [&](std::size_t i) { return within[i]; }, x, p,
        [&](std::size_t i) {
          found[part].pairs.push_back(candidates[i]);
          found[part].reach_m.push_back(reach[i]);
        });
  });
  out.end = x + p;
  out.pairs.clear();
  out.reach_m.clear();
  for (const OfPart& part : found) {
    out.pairs.insert(out.pairs.end(), part.pairs.begin(), part.pairs.end());
    out.reach_m.insert(out.reach_m.end(), part.reach_m.begin(), part.reach_m.end());
  }
}

bool SelfSearch::Found::holds(const Positions& x, const Positions& p) const {
  return std::all_of(vertices.begin(), vertices.end(), [&](int v) {
    const Eigen::RowVector3d from_end = x.row(v) - end.row(v);
    const double margin = margin_m[static_cast<std::size_t>(v)];
    return std::max(from_end.squaredNorm(), (from_end + p.row(v)).squaredNorm()) <= margin * margin;
  });
}

void SelfSearch::pairs(const Positions& x, const Positions& p, double within_m, std::vector<ContactPair>& out) {
  OpenFace::Places at_risk = open_face_.at_risk(x, p, within_m);
  const bool anew = within_m != within_m_;
  const bool face = anew || !at_risk.within(searched_) || !of_face_.holds(x, p);
  const bool others = anew || !of_others_.holds(x, p);
  within_m_ = within_m;
  if (face) {
    searched_ = std::move(at_risk);
    search_face(x, p);
  }
  if (others) search_others(x, p);
  if (face || others) ++num_searches_;
  for (const Found* found : {&of_face_, &of_others_}) {
    collect(found->pairs.size(), out, [&](std::size_t first, std::size_t last, std::vector<ContactPair>& some) {
      for_each_coming_near(
          found->pairs, first, last, [&](std::size_t i) { return found->reach_m[i]; }, x, p,
          [&](std::size_t i) { some.push_back(found->pairs[i]); });
    });
  }
}

void SelfSearch::around(const std::vector<char>& wanted, const std::vector<double>& reach_m, const Positions& x,
                        double within_m, std::vector<ContactPair>& out) {
  const Surface& gel = mesh_.gel;
  // The trees fit until a fixed vertex has left its fitted position by the margin.
  const bool fits = fitted_.rows() > 0 && std::all_of(gel.vertices.begin(), gel.vertices.end(), [&](int v) {
                      return reach_m[v] > 0.0 || (x.row(v) - fitted_.row(v)).squaredNorm() <= margin_m_ * margin_m_;
                    });
  if (!fits) {
    fitted_ = x;
    const std::vector<Box> boxes = boxes_of(gel.vertices, x, Positions::Zero(x.rows(), 3), {});
    fit(face_, boxes, 0.0);
    fit(others_, boxes, 0.0);
  }
  // Largest distance of each vertex from its position in the trees, without the margin.
  std::vector<double> from_box = reach_m;
  double of_others = 0.0;
  for (const int v : gel.vertices) {
    if (reach_m[v] == 0.0) continue;
    from_box[v] += (x.row(v) - fitted_.row(v)).norm();
    if (!wanted[v]) of_others = std::max(of_others, from_box[v]);
  }
  // The one of two wanted primitives with the longer reach finds the other, which may move as far from its own box.
  const auto box_of = [&](const auto& vertices, double reach) {
    return grown(box_around(x, vertices), within_m + margin_m_ + reach + std::max(reach, of_others));
  };
  const std::array<const Part*, 2> parts{&face_, &others_};
  for (const int v : gel.vertices) {
    if (!wanted[v]) continue;
    const Box box = box_of(std::array<int, 1>{v}, from_box[v]);
    for (const Part* part : parts) {
      part->triangle_tree.query(box, [&](int j) {
        const auto& t = gel.triangles[part->triangles[j]];
        if (!has_one(wanted, t) || farthest_reach(from_box, t) <= from_box[v]) offer(point_triangle_pair(v, t), out);
      });
    }
  }
  for (const auto& t : gel.triangles) {
    if (!has_one(wanted, t)) continue;
    const double reach = farthest_reach(from_box, t);
    const Box box = box_of(t, reach);
    for (const Part* part : parts) {
      part->vertex_tree.query(box, [&](int j) {
        const int v = gel.vertices[part->vertices[j]];
        if (!wanted[v] || from_box[v] < reach) offer(point_triangle_pair(v, t), out);
      });
    }
  }
  for (int i = 0; i < static_cast<int>(gel.edges.size()); ++i) {
    const auto& e = gel.edges[i];
    if (!has_one(wanted, e)) continue;
    const double reach = farthest_reach(from_box, e);
    const Box box = box_of(e, reach);
    for (const Part* part : parts) {
      part->edge_tree.query(box, [&](int k) {
        const int j = part->edges[k];
        const auto& f = gel.edges[j];
        const double other = farthest_reach(from_box, f);
        if (!has_one(wanted, f) || other < reach || (other == reach && i < j)) offer(edge_edge_pair(e, f), out);
      });
    }
  }
}

}  // namespace tacipc
