#include <algorithm>
#include <array>
#include <map>

#include "common/base/disjoint_sets.h"
#include "common/base/error.h"
#include "stages/object/decimate/doctor_steps.h"

namespace tacipc {
namespace {

/// A face counts as having no area if its height is below this fraction of its longest edge.
constexpr double kFlatRelativeHeight = 1e-9;
/// Each pass of flips may reveal new faces without area; chains in real files are short.
constexpr int kMaxPasses = 20;

/// Merges each set into its lowest vertex.
/// \return number of vertices removed
std::int64_t merge(DisjointSets& sets, Triangles& triangles) {
  std::int64_t merged = 0;
  for (int v = 0; v < sets.size(); ++v) merged += sets.root(v) != v ? 1 : 0;
  for (int& v : triangles.reshaped()) v = sets.root(v);
  return merged;
}

/// Vertices of edges that belong to a single face, ascending.
std::vector<int> open_vertices(const Triangles& triangles) {
  std::vector<int> open;
  for_each_edge(edge_uses(triangles), [&](std::span<const EdgeUse> edge) {
    if (edge.size() == 1) open.insert(open.end(), {edge[0].low, edge[0].high});
  });
  std::ranges::sort(open);
  open.erase(std::unique(open.begin(), open.end()), open.end());
  return open;
}

struct Shape {
  int longest;    // half edge
  int shortest;   // half edge
  double length;  // length of the longest edge
  double shortest_length;
  double height;
};

Shape shape_of(const TriangleMesh& mesh, int face) {
  Shape shape{.longest = 3 * face, .shortest = 3 * face, .length = -1.0, .shortest_length = 1e300, .height = 0.0};
  for (int k = 0; k < 3; ++k) {
    const double length = (corner(mesh, face, (k + 1) % 3) - corner(mesh, face, k)).norm();
    if (length > shape.length) shape.longest = 3 * face + k, shape.length = length;
    if (length < shape.shortest_length) shape.shortest = 3 * face + k, shape.shortest_length = length;
  }
  if (shape.length > 0.0) shape.height = 2.0 * area_vector(mesh, face).norm() / shape.length;
  return shape;
}

bool names_a_vertex_twice(const Triangles& triangles, Eigen::Index f) {
  return triangles(f, 0) == triangles(f, 1) || triangles(f, 1) == triangles(f, 2) || triangles(f, 2) == triangles(f, 0);
}

std::int64_t drop_collapsed_faces(TriangleMesh& mesh) {
  std::vector<char> keep(mesh.num_triangles(), 1);
  std::int64_t dropped = 0;
  for (Eigen::Index f = 0; f < mesh.num_triangles(); ++f)
    if (names_a_vertex_twice(mesh.triangles, f)) keep[f] = 0, ++dropped;
  if (dropped > 0) mesh.triangles = select_faces(mesh.triangles, keep);
  return dropped;
}

/// Makes one pass over the faces without area.
/// \return true if it changed something
bool treat_flat_faces(TriangleMesh& mesh, DoctorReport& report) {
  std::vector<int> flat;
  std::vector<Shape> shapes;
  for (int f = 0; f < static_cast<int>(mesh.num_triangles()); ++f) {
    const Shape shape = shape_of(mesh, f);
    if (shape.height > kFlatRelativeHeight * shape.length) continue;
    flat.push_back(f);
    shapes.push_back(shape);
  }
  if (flat.empty()) return false;
  DisjointSets same(mesh.num_vertices());
  std::vector<char> keep(mesh.num_triangles(), 1);
  std::vector<char> touched(keep.size(), 0);
  const std::vector<EdgeUse> uses = edge_uses(mesh.triangles);
  const auto same_edge = [&](int a, int b) {
    const auto [low, high] = std::minmax({a, b});
    return std::equal_range(uses.begin(), uses.end(), EdgeUse{low, high, 0}, [](const EdgeUse& x, const EdgeUse& y) {
      return x.low != y.low ? x.low < y.low : x.high < y.high;
    });
  };
  for (std::size_t i = 0; i < flat.size(); ++i) {
    const int face = flat[i];
    const Shape& shape = shapes[i];
    if (touched[face] != 0) continue;
    touched[face] = 1;
    if (shape.shortest_length <= kFlatRelativeHeight * shape.length) {
      same.join(origin_of(mesh.triangles, shape.shortest), target_of(mesh.triangles, shape.shortest));
      continue;
    }
    // The middle corner c lies on the longest edge ab: the neighbour abd becomes acd and cbd.
    const int a = origin_of(mesh.triangles, shape.longest), b = target_of(mesh.triangles, shape.longest);
    const int c = target_of(mesh.triangles, next_in_face(shape.longest));
    const auto [begin, end] = same_edge(a, b);
    keep[face] = 0;
    ++report.degenerate_faces;
    if (end - begin != 2) continue;  // open, or left to the check of edges
    const int other = begin->half_edge / 3 == face ? (begin + 1)->half_edge : begin->half_edge;
    const int d = target_of(mesh.triangles, next_in_face(other));
    const auto existing = same_edge(c, d);
    if (touched[other / 3] != 0 || c == d || existing.first != existing.second) {
      keep[face] = 1;  // next pass, after the neighbour is treated
      --report.degenerate_faces;
      continue;
    }
    touched[other / 3] = 1;
    const int p = origin_of(mesh.triangles, other), q = target_of(mesh.triangles, other);
    mesh.triangles.row(other / 3) << p, c, d;
    mesh.triangles.row(face) << c, q, d;
    keep[face] = 1;
  }
  mesh.triangles = select_faces(mesh.triangles, keep);
  report.merged_vertices += merge(same, mesh.triangles);
  report.degenerate_faces += drop_collapsed_faces(mesh);
  return true;
}

}  // namespace

void weld_open_vertices(TriangleMesh& mesh, double distance_m, DoctorReport& report) {
  for (const double distance : {0.0, distance_m}) {
    const std::vector<int> open = open_vertices(mesh.triangles);
    if (open.empty()) return;
    std::vector<int> order = open;
    const auto before = [&](int u, int v) {
      for (int i = 0; i < 3; ++i)
        if (mesh.positions(u, i) != mesh.positions(v, i)) return mesh.positions(u, i) < mesh.positions(v, i);
      return u < v;
    };
    std::ranges::sort(order, before);
    DisjointSets same(mesh.num_vertices());
    for (std::size_t i = 0; i < order.size(); ++i)
      for (std::size_t j = i + 1;
           j < order.size() && mesh.positions(order[j], 0) - mesh.positions(order[i], 0) <= distance; ++j) {
        if ((mesh.positions.row(order[i]) - mesh.positions.row(order[j])).norm() <= distance)
          same.join(order[i], order[j]);
        else if (distance == 0.0)
          break;  // equal positions are adjacent
      }
    report.merged_vertices += merge(same, mesh.triangles);
  }
}

void remove_degenerate_faces(TriangleMesh& mesh, DoctorReport& report) {
  report.degenerate_faces += drop_collapsed_faces(mesh);
  for (int pass = 0; treat_flat_faces(mesh, report); ++pass)
    if (pass == kMaxPasses) throw DataError("faces without area remain after {} passes of edge flips", kMaxPasses);
}

void remove_duplicate_faces(TriangleMesh& mesh, DoctorReport& report) {
  const int num_faces = static_cast<int>(mesh.num_triangles());
  struct Keyed {
    std::array<int, 3> vertices;
    int face;
  };
  std::vector<Keyed> faces(num_faces);
  for (int f = 0; f < num_faces; ++f) {
    faces[f] = {{mesh.triangles(f, 0), mesh.triangles(f, 1), mesh.triangles(f, 2)}, f};
    std::ranges::sort(faces[f].vertices);
  }
  std::ranges::sort(faces, [](const Keyed& a, const Keyed& b) {
    return a.vertices != b.vertices ? a.vertices < b.vertices : a.face < b.face;
  });
  std::map<std::pair<int, int>, int> uses;  // built only if there is a duplicate
  std::vector<char> keep(num_faces, 1);
  std::int64_t removed = 0;
  for (std::size_t first = 0, last = 0; first < faces.size(); first = last) {
    while (last < faces.size() && faces[last].vertices == faces[first].vertices) ++last;
    const int copies = static_cast<int>(last - first);
    if (copies == 1) continue;
    if (uses.empty())
      for (const EdgeUse& use : edge_uses(mesh.triangles)) ++uses[{use.low, use.high}];
    const auto [u, v, w] = faces[first].vertices;
    // An edge with one other face needs this one to close; no edge needs a sheet within or next to a closed surface.
    const auto others = [&](int a, int b) { return uses[{a, b}] - copies; };
    const bool needed = others(u, v) == 1 || others(v, w) == 1 || others(u, w) == 1;
    for (std::size_t i = first + (needed ? 1 : 0); i < last; ++i) keep[faces[i].face] = 0, ++removed;
  }
  if (removed > 0) mesh.triangles = select_faces(mesh.triangles, keep);
  report.duplicate_faces += removed;
}

}  // namespace tacipc
