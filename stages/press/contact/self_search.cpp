#include "stages/press/contact/self_search.h"

#include <cmath>

#include "stages/press/contact/near_pairs.h"
#include "stages/press/contact/pair_pack.h"
#include "stages/press/contact/plane_filter.h"
#include "stages/press/contact/search_tools.h"

namespace tacipc {
namespace {

constexpr double kRoom = 0.25;  // of the radius, on each side

bool share_vertex(int v, const std::array<int, 3>& t) { return v == t[0] || v == t[1] || v == t[2]; }

bool share_vertex(const std::array<int, 2>& a, const std::array<int, 2>& b) {
  return a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1];
}

/// Boxes around primitives on their way from x to x + p, grown by `margin`.
template <typename Primitives>
std::vector<Box> swept(const Primitives& primitives, const Positions& x, const Positions& end, double margin) {
  std::vector<Box> boxes(primitives.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, boxes.size(), 2048), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      boxes[i] = grown(box_around(x, primitives[i]).merged(box_around(end, primitives[i])), margin);
  });
  return boxes;
}

/// Calls keep(i) for pairs first … last − 1 that come nearer than reach_m[i] + room on the way, in order.
template <typename Keep>
void for_each_coming_near(const std::vector<ContactPair>& pairs, const std::vector<double>& reach_m, double room,
                          std::size_t first, std::size_t last, const Positions& x, const Positions& p, Keep&& keep) {
  while (first < last) {
    const PairPack pack(pairs, first, last);
    Pack wanted = {};
    for (int l = 0; l < pack.count; ++l) wanted[l] = reach_m[first + static_cast<std::size_t>(l)] + room;
    const unsigned apart = apart_all_the_way(x.data(), p.data(), 1.0, pack.pairs, pack.kind(), 0.0, wanted);
    for (int l = 0; l < pack.count; ++l) {
      if (!(apart >> l & 1U)) keep(first + static_cast<std::size_t>(l));
    }
    first += static_cast<std::size_t>(pack.count);
  }
}

}  // namespace

SelfSearch::SelfSearch(const ContactMesh& mesh)
    : mesh_(mesh),
      vertices_(boxes_at(OneVertex{mesh.gel.vertices}, mesh.rest_positions)),
      edges_(boxes_at(mesh.gel.edges, mesh.rest_positions)),
      triangles_(boxes_at(mesh.gel.triangles, mesh.rest_positions)) {}

void SelfSearch::search(const Positions& x, const Positions& p, double radius_m) {
  ++num_searches_;
  radius_m_ = radius_m;
  const Positions end = x + p;
  // Half of the distance looked for on each side.
  const double margin = (0.5 + kRoom) * radius_m, room = kRoom * radius_m;
  room_ = swept(OneVertex{mesh_.gel.vertices}, x, end, room);
  vertices_.refit(swept(OneVertex{mesh_.gel.vertices}, x, end, margin));
  edges_.refit(swept(mesh_.gel.edges, x, end, margin));
  triangles_.refit(swept(mesh_.gel.triangles, x, end, margin));

  const Surface& gel = mesh_.gel;
  struct Found {
    std::vector<ContactPair> pairs;
    std::vector<double> reach_m;
  };
  std::vector<Found> found(2 * Bvh::kParts);
  tbb::parallel_for(0, 2 * Bvh::kParts, [&](int part) {
    std::vector<ContactPair> candidates;
    if (part < Bvh::kParts) {
      vertices_.overlaps(triangles_, part, [&](int i, int j) {
        const int v = gel.vertices[i];
        if (!share_vertex(v, gel.triangles[j])) candidates.push_back(point_triangle_pair(v, gel.triangles[j]));
      });
    } else {
      edges_.overlaps(edges_, part - Bvh::kParts, [&](int i, int j) {
        const auto [first, second] = std::minmax(i, j);
        if (!share_vertex(gel.edges[first], gel.edges[second]))
          candidates.push_back(edge_edge_pair(gel.edges[first], gel.edges[second]));
      });
    }
    std::vector<double> reach = coarse_squared_distances(candidates, mesh_.rest_positions);
    // Zero: edges too parallel to tell.
    for (double& r : reach) r = r > 0.0 ? std::min(radius_m, 0.5 * std::sqrt(r)) : radius_m;
    for_each_coming_near(candidates, reach, 2.0 * room, 0, candidates.size(), x, p, [&](std::size_t i) {
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

void SelfSearch::pairs(const Positions& x, const Positions& p, double radius_m, std::vector<ContactPair>& out) {
  const auto within_room = [&] {
    for (std::size_t i = 0; i < room_.size(); ++i) {
      const int v = mesh_.gel.vertices[i];
      if (!room_[i].contains(Vector3(x.row(v))) || !room_[i].contains(Vector3(x.row(v) + p.row(v)))) return false;
    }
    return true;
  };
  if (radius_m != radius_m_ || !within_room()) search(x, p, radius_m);
  collect(near_.size(), out, [&](std::size_t first, std::size_t last, std::vector<ContactPair>& found) {
    for_each_coming_near(near_, reach_m_, 0.0, first, last, x, p, [&](std::size_t i) { found.push_back(near_[i]); });
  });
}

void SelfSearch::around(const std::vector<bool>& moves, const Positions& x, double radius_m, double reach_m,
                        std::vector<ContactPair>& out) const {
  const Surface& gel = mesh_.gel;
  const auto moving = [&](const auto& vertices) {
    return std::any_of(vertices.begin(), vertices.end(), [&](int v) { return moves[v]; });
  };
  // The trees' boxes are grown by half the radius; of two moving parts both may come nearer.
  const double margin = 0.5 * radius_m + 2.0 * reach_m;
  for (const int v : gel.vertices) {
    if (!moves[v]) continue;
    const std::array<int, 1> one{v};
    triangles_.query(grown(box_around(x, one), margin), [&](int j) {
      if (!share_vertex(v, gel.triangles[j])) out.push_back(point_triangle_pair(v, gel.triangles[j]));
    });
  }
  for (const auto& t : gel.triangles) {
    if (!moving(t)) continue;
    vertices_.query(grown(box_around(x, t), margin), [&](int j) {
      const int v = gel.vertices[j];
      if (!moves[v] && !share_vertex(v, t)) out.push_back(point_triangle_pair(v, t));
    });
  }
  for (int i = 0; i < static_cast<int>(gel.edges.size()); ++i) {
    const auto& e = gel.edges[i];
    if (!moving(e)) continue;
    edges_.query(grown(box_around(x, e), margin), [&](int j) {
      const auto& f = gel.edges[j];
      if ((i < j || !moving(f)) && !share_vertex(e, f)) out.push_back(edge_edge_pair(e, f));
    });
  }
}

}  // namespace tacipc
