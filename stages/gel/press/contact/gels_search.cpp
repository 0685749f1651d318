#include "stages/gel/press/contact/gels_search.h"

#include <algorithm>

#include "stages/gel/press/contact/search_tools.h"

namespace tacipc {
namespace {

/// The primitives whose way from x to x + p, grown by `margin`, touches a box, and a tree around those.
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

Surface shifted(Surface surface, int by) {
  for (int& v : surface.vertices) v += by;
  for (auto& edge : surface.edges) {
    for (int& v : edge) v += by;
  }
  for (auto& triangle : surface.triangles) {
    for (int& v : triangle) v += by;
  }
  return surface;
}

void shift(std::vector<ContactPair>& pairs, std::size_t first, int by) {
  for (std::size_t i = first; i < pairs.size(); ++i) {
    for (int& v : pairs[i].vertices) v += by;
  }
}

auto own_rows(const GelPart& part, const Positions& rows) {
  return rows.middleRows(part.first_vertex, part.mesh->num_gel_vertices);
}

}  // namespace

GelsSearch::GelsSearch(const ContactMesh& mesh)
    : mesh_(mesh), turns_(mesh.gels.size(), Matrix3::Identity()), frames_(mesh.gels.size()) {
  if (mesh.gels.empty()) each_.push_back(std::make_unique<SelfSearch>(mesh));
  for (const GelPart& gel : mesh.gels) {
    each_.push_back(std::make_unique<SelfSearch>(*gel.mesh));
    surfaces_.push_back(shifted(gel.mesh->gel, gel.first_vertex));
  }
}

void GelsSearch::forget() {
  for (const auto& search : each_) search->forget();
}

int GelsSearch::num_searches() const {
  int sum = 0;
  for (const auto& search : each_) sum += search->num_searches();
  return sum;
}

Positions GelsSearch::places(std::size_t gel, const Positions& x) const {
  const GelPart& part = mesh_.gels[gel];
  if (part.anchor < 0) return frames_[gel].places(own_rows(part, x));
  return displacements(gel, x).rowwise() + part.mesh->rest_positions.row(part.anchor);
}

Positions GelsSearch::displacements(std::size_t gel, const Positions& p) const {
  const GelPart& part = mesh_.gels[gel];
  const auto own = own_rows(part, p);
  if (part.anchor < 0) return frames_[gel].displacements(own);
  return (own.rowwise() - own.row(part.anchor)) * turns_[gel];
}

void GelsSearch::pairs(const Positions& x, const Positions& p, double d_hat_m, std::vector<ContactPair>& out) {
  if (mesh_.gels.empty()) return each_[0]->pairs(x, p, d_hat_m, out);
  for (std::size_t g = 0; g < each_.size(); ++g) {
    const GelPart& part = mesh_.gels[g];
    const std::size_t before = out.size();
    if (part.anchor < 0) frames_[g] = body_frame(part.mesh->rest_positions, own_rows(part, x) + own_rows(part, p));
    each_[g]->pairs(places(g, x), displacements(g, p), d_hat_m, out);
    shift(out, before, part.first_vertex);
  }
  across(x, p, d_hat_m, out);
}

void GelsSearch::around(const std::vector<bool>& moves, const Positions& x, double d_hat_m, double reach_m,
                        std::vector<ContactPair>& out) const {
  if (mesh_.gels.empty()) return each_[0]->around(moves, x, d_hat_m, reach_m, out);
  for (std::size_t g = 0; g < each_.size(); ++g) {
    const GelPart& part = mesh_.gels[g];
    const auto first = moves.begin() + part.first_vertex;
    const std::vector<bool> own(first, first + part.mesh->num_gel_vertices);
    const std::size_t before = out.size();
    each_[g]->around(own, places(g, x), d_hat_m, reach_m, out);
    shift(out, before, part.first_vertex);
  }
  std::vector<ContactPair> found;
  across(x, Positions::Zero(x.rows(), 3), d_hat_m + 2.0 * reach_m, found);
  std::copy_if(found.begin(), found.end(), std::back_inserter(out), [&](const ContactPair& pair) {
    return std::any_of(pair.vertices.begin(), pair.vertices.end(), [&](int v) { return moves[v]; });
  });
}

void GelsSearch::across(const Positions& x, const Positions& p, double within_m, std::vector<ContactPair>& out) const {
  const Positions end = x + p;
  const double margin = 0.5 * within_m;
  std::vector<Box> boxes;
  for (const Surface& surface : surfaces_) {
    Box box = box_around(x, surface.vertices);
    box.extend(box_around(end, surface.vertices));
    boxes.push_back(grown(box, margin));
  }
  for (std::size_t a = 0; a < surfaces_.size(); ++a) {
    for (std::size_t b = a + 1; b < surfaces_.size(); ++b) {
      if (!boxes[a].intersects(boxes[b])) continue;
      const Box both = boxes[a].intersection(boxes[b]);
      const Surface &of_a = surfaces_[a], &of_b = surfaces_[b];
      const OneVertex points_a{of_a.vertices}, points_b{of_b.vertices};
      const Near near_points_a(points_a, x, end, margin, both), near_points_b(points_b, x, end, margin, both);
      const Near near_a(of_a.triangles, x, end, margin, both), near_b(of_b.triangles, x, end, margin, both);
      const Near edges_a(of_a.edges, x, end, margin, both), edges_b(of_b.edges, x, end, margin, both);
      for_each_touching(near_points_a, near_b, [&](std::size_t i, std::size_t j) {
        out.push_back(point_triangle_pair(of_a.vertices[i], of_b.triangles[j]));
      });
      for_each_touching(near_points_b, near_a, [&](std::size_t i, std::size_t j) {
        out.push_back(point_triangle_pair(of_b.vertices[i], of_a.triangles[j]));
      });
      for_each_touching(edges_a, edges_b, [&](std::size_t i, std::size_t j) {
        out.push_back(edge_edge_pair(of_a.edges[i], of_b.edges[j]));
      });
    }
  }
}

}  // namespace tacipc
