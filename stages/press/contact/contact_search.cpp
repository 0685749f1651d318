#include "stages/press/contact/contact_search.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace tacipc {
namespace {

constexpr std::size_t kChunk = 512;
constexpr double kRoom = 0.25;  // of the radius, around each box that is searched with

Box swept(const Positions& x, const Positions& p, int v) {
  Box box;
  const Vector3 start = x.row(v), end = x.row(v) + p.row(v);
  box.extend(start);
  box.extend(end);
  return box;
}

/// Boxes around primitives swept from x to x + p, grown by `margin`.
template <typename Primitives>
void fill_boxes(const Primitives& primitives, const Positions& x, const Positions& p, double margin,
                std::vector<Box>& boxes) {
  boxes.resize(primitives.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, primitives.size(), 4 * kChunk), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      Box box;
      for (const int v : primitives[i]) box.extend(swept(x, p, v));
      box.min().array() -= margin;
      box.max().array() += margin;
      boxes[i] = box;
    }
  });
}

struct OneVertex {
  const std::vector<int>& vertices;
  std::size_t size() const { return vertices.size(); }
  std::array<int, 1> operator[](std::size_t i) const { return {vertices[i]}; }
};

bool share_vertex(int v, const std::array<int, 3>& t) { return v == t[0] || v == t[1] || v == t[2]; }

bool share_vertex(const std::array<int, 2>& a, const std::array<int, 2>& b) {
  return a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1];
}

/// Runs query(i, out) for i < count in chunks and joins what they found in order.
template <typename Item, typename Query>
void collect(std::size_t count, std::vector<Item>& out, Query&& query) {
  std::vector<std::vector<Item>> found((count + kChunk - 1) / kChunk);
  tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t chunk) {
    for (std::size_t i = chunk * kChunk; i < std::min(count, (chunk + 1) * kChunk); ++i)
      query(static_cast<int>(i), found[chunk]);
  });
  for (const auto& part : found) out.insert(out.end(), part.begin(), part.end());
}

bool touch(const Box& a, const Box& b) {
  return (a.min().array() <= b.max().array()).all() && (b.min().array() <= a.max().array()).all();
}

std::vector<Box> grown(std::vector<Box> boxes, double by) {
  for (Box& box : boxes) {
    box.min().array() -= by;
    box.max().array() += by;
  }
  return boxes;
}

bool contain(const std::vector<Box>& outer, const std::vector<Box>& inner) {
  for (std::size_t i = 0; i < inner.size(); ++i) {
    if (!outer[i].contains(inner[i])) return false;
  }
  return true;
}

ContactPair point_triangle(int v, const std::array<int, 3>& t) {
  return {ContactPair::Kind::point_triangle, {v, t[0], t[1], t[2]}};
}

ContactPair edge_edge(const std::array<int, 2>& e, const std::array<int, 2>& f) {
  return {ContactPair::Kind::edge_edge, {e[0], e[1], f[0], f[1]}};
}

std::vector<Box> rest_boxes(const ContactMesh& mesh, const auto& primitives) {
  std::vector<Box> boxes;
  fill_boxes(primitives, mesh.rest_positions, Positions::Zero(mesh.num_vertices(), 3), 0.0, boxes);
  return boxes;
}

}  // namespace

FourPoints gather(const Positions& x, const ContactPair& pair) {
  return {x.row(pair.vertices[0]), x.row(pair.vertices[1]), x.row(pair.vertices[2]), x.row(pair.vertices[3])};
}

ClosestFeature closest_feature(const ContactPair& pair, const FourPoints& x) {
  return pair.kind == ContactPair::Kind::point_triangle ? closest_point_triangle(x) : closest_edge_edge(x);
}

ContactSearch::ContactSearch(const ContactMesh& mesh)
    : mesh_(mesh),
      gel_vertices_(rest_boxes(mesh, OneVertex{mesh.gel.vertices})),
      gel_edges_(rest_boxes(mesh, mesh.gel.edges)),
      gel_triangles_(rest_boxes(mesh, mesh.gel.triangles)),
      object_vertices_(rest_boxes(mesh, OneVertex{mesh.object.vertices})),
      object_edges_(rest_boxes(mesh, mesh.object.edges)),
      object_triangles_(rest_boxes(mesh, mesh.object.triangles)) {}

void ContactSearch::fill(const Positions& x, const Positions& p, double radius_m) {
  // The gel's boxes carry the radius against the object's bare ones; gel against gel needs half on each side.
  fill_boxes(OneVertex{mesh_.gel.vertices}, x, p, radius_m, now_.gel_vertices);
  fill_boxes(mesh_.gel.edges, x, p, 0.5 * radius_m, now_.gel_edges);
  fill_boxes(mesh_.gel.triangles, x, p, 0.0, now_.gel_triangles);
  fill_boxes(OneVertex{mesh_.object.vertices}, x, p, radius_m, now_.object_vertices);
  fill_boxes(mesh_.object.edges, x, p, 0.5 * radius_m, now_.object_edges);
  fill_boxes(mesh_.object.triangles, x, p, 0.0, now_.object_triangles);
}

/// Whether all boxes are within those last searched with. Vertices' boxes suffice: the others are around them.
bool ContactSearch::within_room(double radius_m) const {
  return radius_m == searched_radius_m_ && contain(searched_.gel_vertices, now_.gel_vertices) &&
         contain(searched_.object_vertices, now_.object_vertices);
}

void ContactSearch::search(double radius_m) {
  ++num_searches_;
  const double room = kRoom * radius_m;
  searched_ = {grown(now_.gel_vertices, room),    grown(now_.gel_edges, room),    grown(now_.gel_triangles, room),
               grown(now_.object_vertices, room), grown(now_.object_edges, room), grown(now_.object_triangles, room)};
  searched_radius_m_ = radius_m;
  gel_vertices_.refit(searched_.gel_vertices);
  gel_edges_.refit(searched_.gel_edges);
  gel_triangles_.refit(searched_.gel_triangles);
  object_vertices_.refit(searched_.object_vertices);
  object_edges_.refit(searched_.object_edges);
  object_triangles_.refit(searched_.object_triangles);

  const auto& gel = mesh_.gel;
  const auto all_of = [](const Bvh& tree, const std::vector<Box>& boxes, std::vector<Near>& out, auto&& keep) {
    out.clear();
    collect(boxes.size(), out, [&](int i, std::vector<Near>& found) {
      tree.query(boxes[i], [&](int j) {
        if (keep(i, j)) found.push_back({i, j});
      });
    });
  };
  const auto every = [](int, int) { return true; };
  all_of(object_triangles_, searched_.gel_vertices, vertex_object_triangle_, every);
  all_of(gel_triangles_, searched_.gel_vertices, vertex_gel_triangle_,
         [&](int i, int j) { return !share_vertex(gel.vertices[i], gel.triangles[j]); });
  all_of(object_vertices_, searched_.gel_triangles, triangle_object_vertex_, every);
  all_of(object_edges_, searched_.gel_edges, edge_object_edge_, every);
  all_of(gel_edges_, searched_.gel_edges, edge_gel_edge_,
         [&](int i, int j) { return i < j && !share_vertex(gel.edges[i], gel.edges[j]); });
}

std::vector<ContactPair> ContactSearch::pairs(const Positions& x, const Positions& p, double radius_m) {
  fill(x, p, radius_m);
  if (!within_room(radius_m)) search(radius_m);

  // Only those whose boxes touch as they are now: what else was found must not matter.
  const auto& gel = mesh_.gel;
  const auto& object = mesh_.object;
  std::vector<ContactPair> found;
  const auto keep = [&](const std::vector<Near>& near, const std::vector<Box>& first, const std::vector<Box>& second,
                        auto&& pair_of) {
    collect(near.size(), found, [&](int k, std::vector<ContactPair>& out) {
      const auto [i, j] = near[static_cast<std::size_t>(k)];
      if (touch(first[i], second[j])) out.push_back(pair_of(i, j));
    });
  };
  keep(vertex_object_triangle_, now_.gel_vertices, now_.object_triangles,
       [&](int i, int j) { return point_triangle(gel.vertices[i], object.triangles[j]); });
  keep(vertex_gel_triangle_, now_.gel_vertices, now_.gel_triangles,
       [&](int i, int j) { return point_triangle(gel.vertices[i], gel.triangles[j]); });
  keep(triangle_object_vertex_, now_.gel_triangles, now_.object_vertices,
       [&](int i, int j) { return point_triangle(object.vertices[j], gel.triangles[i]); });
  keep(edge_object_edge_, now_.gel_edges, now_.object_edges,
       [&](int i, int j) { return edge_edge(gel.edges[i], object.edges[j]); });
  keep(edge_gel_edge_, now_.gel_edges, now_.gel_edges,
       [&](int i, int j) { return edge_edge(gel.edges[i], gel.edges[j]); });
  return found;
}

std::vector<ContactPair> ContactSearch::pairs_around(const std::vector<bool>& moves, const Positions& x,
                                                     double radius_m, double reach_m) const {
  const auto& gel = mesh_.gel;
  const auto& object = mesh_.object;
  const auto box_of = [&](const auto& vertices, double by) {
    Box box;
    for (const int v : vertices) box.extend(Vector3(x.row(v)));
    box.min().array() -= by;
    box.max().array() += by;
    return box;
  };
  const auto moving = [&](const auto& vertices) {
    return std::any_of(vertices.begin(), vertices.end(), [&](int v) { return moves[v]; });
  };
  // Of two moving parts of the gel both may come nearer.
  const double object_margin = radius_m + reach_m, gel_margin = radius_m + 2.0 * reach_m;
  std::vector<ContactPair> found;
  for (const int v : gel.vertices) {
    if (!moves[v]) continue;
    const std::array<int, 1> one{v};
    object_triangles_.query(box_of(one, object_margin),
                            [&](int j) { found.push_back(point_triangle(v, object.triangles[j])); });
    gel_triangles_.query(box_of(one, gel_margin), [&](int j) {
      if (!share_vertex(v, gel.triangles[j])) found.push_back(point_triangle(v, gel.triangles[j]));
    });
  }
  for (const auto& t : gel.triangles) {
    if (!moving(t)) continue;
    object_vertices_.query(box_of(t, object_margin),
                           [&](int j) { found.push_back(point_triangle(object.vertices[j], t)); });
    gel_vertices_.query(box_of(t, gel_margin), [&](int j) {
      const int v = gel.vertices[j];
      if (!moves[v] && !share_vertex(v, t)) found.push_back(point_triangle(v, t));
    });
  }
  for (int i = 0; i < static_cast<int>(gel.edges.size()); ++i) {
    const auto& e = gel.edges[i];
    if (!moving(e)) continue;
    object_edges_.query(box_of(e, object_margin), [&](int j) { found.push_back(edge_edge(e, object.edges[j])); });
    gel_edges_.query(box_of(e, gel_margin), [&](int j) {
      const auto& f = gel.edges[j];
      if ((i < j || !moving(f)) && !share_vertex(e, f)) found.push_back(edge_edge(e, f));
    });
  }
  return found;
}

double smallest_distance(const std::vector<ContactPair>& pairs, const Positions& x, double none) {
  double smallest = none * none;
  for (const ContactPair& pair : pairs)
    smallest = std::min(smallest, closest_feature(pair, gather(x, pair)).squared_distance);
  return std::sqrt(smallest);
}

}  // namespace tacipc
