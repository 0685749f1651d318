#include "stages/press/contact/contact_search.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace tacipc {
namespace {

constexpr std::size_t kChunk = 512;

/// Boxes around primitives swept from x to x + p, grown by `margin`.
template <typename Primitives>
void fill_boxes(const Primitives& primitives, const Positions& x, const Positions& p, double margin,
                std::vector<Box>& boxes) {
  boxes.resize(primitives.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, primitives.size(), 4 * kChunk), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      Box box;
      for (const int v : primitives[i]) {
        const Vector3 start = x.row(v), end = x.row(v) + p.row(v);
        box.extend(start);
        box.extend(end);
      }
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
template <typename Query>
void collect(std::size_t count, std::vector<ContactPair>& out, Query&& query) {
  std::vector<std::vector<ContactPair>> found((count + kChunk - 1) / kChunk);
  tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t chunk) {
    for (std::size_t i = chunk * kChunk; i < std::min(count, (chunk + 1) * kChunk); ++i)
      query(static_cast<int>(i), found[chunk]);
  });
  for (const auto& part : found) out.insert(out.end(), part.begin(), part.end());
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
      gel_edges_(rest_boxes(mesh, mesh.gel.edges)),
      gel_triangles_(rest_boxes(mesh, mesh.gel.triangles)),
      object_vertices_(rest_boxes(mesh, OneVertex{mesh.object.vertices})),
      object_edges_(rest_boxes(mesh, mesh.object.edges)),
      object_triangles_(rest_boxes(mesh, mesh.object.triangles)) {}

std::vector<ContactPair> ContactSearch::pairs(const Positions& x, const Positions& p, double radius_m) {
  // The gel's boxes carry the radius against the object's bare ones; gel against gel needs half on each side.
  fill_boxes(OneVertex{mesh_.gel.vertices}, x, p, radius_m, gel_vertex_boxes_);
  fill_boxes(mesh_.gel.edges, x, p, 0.5 * radius_m, gel_edge_boxes_);
  fill_boxes(mesh_.gel.triangles, x, p, 0.0, gel_triangle_boxes_);
  fill_boxes(OneVertex{mesh_.object.vertices}, x, p, radius_m, object_vertex_boxes_);
  fill_boxes(mesh_.object.edges, x, p, 0.5 * radius_m, object_edge_boxes_);
  fill_boxes(mesh_.object.triangles, x, p, 0.0, object_triangle_boxes_);
  gel_edges_.refit(gel_edge_boxes_);
  gel_triangles_.refit(gel_triangle_boxes_);
  object_vertices_.refit(object_vertex_boxes_);
  object_edges_.refit(object_edge_boxes_);
  object_triangles_.refit(object_triangle_boxes_);

  using Kind = ContactPair::Kind;
  const auto& gel = mesh_.gel;
  const auto& object = mesh_.object;
  std::vector<ContactPair> found;
  collect(gel.vertices.size(), found, [&](int i, auto& out) {
    const int v = gel.vertices[i];
    object_triangles_.query(gel_vertex_boxes_[i], [&](int j) {
      const auto& t = object.triangles[j];
      out.push_back({Kind::point_triangle, {v, t[0], t[1], t[2]}});
    });
    gel_triangles_.query(gel_vertex_boxes_[i], [&](int j) {
      const auto& t = gel.triangles[j];
      if (!share_vertex(v, t)) out.push_back({Kind::point_triangle, {v, t[0], t[1], t[2]}});
    });
  });
  collect(gel.triangles.size(), found, [&](int i, auto& out) {
    const auto& t = gel.triangles[i];
    object_vertices_.query(gel_triangle_boxes_[i], [&](int j) {
      out.push_back({Kind::point_triangle, {object.vertices[j], t[0], t[1], t[2]}});
    });
  });
  collect(gel.edges.size(), found, [&](int i, auto& out) {
    const auto& e = gel.edges[i];
    object_edges_.query(gel_edge_boxes_[i], [&](int j) {
      const auto& f = object.edges[j];
      out.push_back({Kind::edge_edge, {e[0], e[1], f[0], f[1]}});
    });
    gel_edges_.query(gel_edge_boxes_[i], [&](int j) {
      const auto& f = gel.edges[j];
      if (i < j && !share_vertex(e, f)) out.push_back({Kind::edge_edge, {e[0], e[1], f[0], f[1]}});
    });
  });
  return found;
}

double smallest_distance(const std::vector<ContactPair>& pairs, const Positions& x, double none) {
  double smallest = none * none;
  for (const ContactPair& pair : pairs)
    smallest = std::min(smallest, closest_feature(pair, gather(x, pair)).squared_distance);
  return std::sqrt(smallest);
}

}  // namespace tacipc
