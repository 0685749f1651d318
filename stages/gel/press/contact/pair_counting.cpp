#include "stages/gel/press/contact/pair_counting.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "stages/gel/press/contact/sharpness.h"

namespace tacipc {
namespace {

/// Edges or corners near vertices, each stored by its lowest and highest vertex.
class PairCells {
 public:
  void add(int point, int a, int b) {
    points_.push_back(point);
    ends_.push_back(static_cast<std::uint64_t>(std::min(a, b)) << 32 | static_cast<std::uint64_t>(std::max(a, b)));
  }

  /// Appends each once, ordered by vertex and then by its ends, independently of the order of the triangles.
  /// \param shape_of returns ContactPair::shape for these ends
  template <typename ShapeOf>
  void append_to(std::vector<ContactPair>& pairs, int num_vertices, double weight, ShapeOf&& shape_of) const {
    if (points_.empty()) return;
    std::vector<std::size_t> start(static_cast<std::size_t>(num_vertices) + 1, 0);
    for (const int p : points_) ++start[p + 1];
    for (std::size_t p = 1; p < start.size(); ++p) start[p] += start[p - 1];
    std::vector<std::uint64_t> of_point(ends_.size());
    std::vector<std::size_t> next(start.begin(), start.end() - 1);
    for (std::size_t i = 0; i < ends_.size(); ++i) of_point[next[points_[i]]++] = ends_[i];
    for (int p = 0; p < num_vertices; ++p) {
      const auto first = of_point.begin() + static_cast<std::ptrdiff_t>(start[p]);
      const auto last = of_point.begin() + static_cast<std::ptrdiff_t>(start[p + 1]);
      std::sort(first, last);
      for (auto it = first, end = std::unique(first, last); it != end; ++it) {
        const int low = static_cast<int>(*it >> 32), high = static_cast<int>(*it & 0xffffffffU);
        pairs.push_back({ContactPair::Kind::point_triangle, {p, low, high, high}, weight, shape_of(low, high)});
      }
    }
  }

 private:
  std::vector<int> points_;
  std::vector<std::uint64_t> ends_;
};

/// Pairs of two rigid bodies: corners with faces and creases with creases, independently of the triangulation.
class ShapePairs {
 public:
  explicit ShapePairs(const ContactMesh& mesh) : mesh_(mesh), shapes_(mesh.object_shapes) {}

  bool are_two_shapes(const ContactPair& pair) const {
    return !shapes_.is_corner.empty() && pair.vertices[0] >= mesh_.num_gel_vertices &&
           pair.vertices[3] >= mesh_.num_gel_vertices;
  }
  bool is_corner(int v) const { return shapes_.is_corner[static_cast<std::size_t>(v)] != 0; }

  /// ContactPair::shape of a corner and a triangle.
  std::uint8_t shape(const std::array<int, 4>& v) const {
    unsigned bits = kIsShape;
    for (int k = 0; k < 3; ++k) {
      if (!is_flat(v[1 + k], v[1 + (k + 1) % 3])) bits |= rim_edge(k);
      if (on_rim(v[1 + k])) bits |= rim_corner(k);
    }
    return static_cast<std::uint8_t>(bits);
  }
  /// ContactPair::shape of a corner and an edge, or a vertex given as both ends.
  std::uint8_t shape(int a, int b) const {
    if (a == b) return on_rim(a) ? kAllRim : kIsShape;
    if (!is_flat(a, b)) return kAllRim;
    return static_cast<std::uint8_t>(kIsShape | (on_rim(a) ? rim_corner(0) : 0U) |
                                     (on_rim(b) ? rim_corner(1) | rim_corner(2) : 0U));
  }

  /// Adds the creases of two edges if both are on one.
  void add_edges(const ContactPair& pair) {
    const auto& v = pair.vertices;
    if (is_flat(v[0], v[1]) || is_flat(v[2], v[3])) return;
    const auto &a = shapes_.crease[edge(v[0], v[1])], &b = shapes_.crease[edge(v[2], v[3])];
    creases_.push_back({ContactPair::Kind::edge_edge, {a[0], a[1], b[0], b[1]}, pair.weight});
  }

  /// Appends each pair of creases once.
  void append_to(std::vector<ContactPair>& pairs) {
    const auto key = [](const ContactPair& pair) { return std::pair(pair.vertices, -pair.weight); };
    std::sort(creases_.begin(), creases_.end(),
              [&](const ContactPair& a, const ContactPair& b) { return key(a) < key(b); });
    const auto end = std::unique(creases_.begin(), creases_.end(),
                                 [](const ContactPair& a, const ContactPair& b) { return a.vertices == b.vertices; });
    pairs.insert(pairs.end(), creases_.begin(), end);
  }

 private:
  std::size_t edge(int a, int b) const { return index_of_edge(mesh_.object, a, b); }
  bool is_flat(int a, int b) const { return shapes_.is_flat[edge(a, b)] != 0; }
  bool on_rim(int v) const { return shapes_.on_rim[static_cast<std::size_t>(v)] != 0; }

  const ContactMesh& mesh_;
  const ShapeFeatures& shapes_;
  std::vector<ContactPair> creases_;
};

}  // namespace

std::vector<ContactPair> weighted(std::vector<ContactPair> pairs, const ContactMesh& mesh, const ContactLaws& laws,
                                  const PairCounting& counting) {
  const auto with_laws = [&](std::vector<ContactPair> all) {
    if (laws.all_alike() && laws.all()[0].stiffness == 1.0) return all;
    for (ContactPair& pair : all) pair.weight *= laws.all()[laws.index(mesh, pair)].stiffness;
    return all;
  };
  if (!counting.once) return with_laws(std::move(pairs));
  using Kind = ContactPair::Kind;
  const auto of_gel = [&](int v) { return v < mesh.num_gel_vertices; };
  const auto sharpness = [&](int a, int b) {
    const Surface& surface = of_gel(a) ? mesh.gel : mesh.object;
    const std::vector<double>& sharp = of_gel(a) ? mesh.gel_edge_sharpness : mesh.object_edge_sharpness;
    return sharp.empty() ? 0.0 : sharp[index_of_edge(surface, a, b)];
  };
  PairCells edges, corners, face_edges, face_corners;
  ShapePairs shapes(mesh);
  for (ContactPair& pair : pairs) {
    const auto& v = pair.vertices;
    if (of_gel(v[0]) && of_gel(v[3]) && (mesh.gels.empty() || mesh.body_of(v[0]) == mesh.body_of(v[3]))) continue;
    const bool two_shapes = shapes.are_two_shapes(pair);
    if (pair.kind == Kind::edge_edge) {
      pair.weight = std::max({counting.edge_weight, sharpness(v[0], v[1]), sharpness(v[2], v[3])});
      if (!two_shapes) continue;
      shapes.add_edges(pair);
      pair.weight = 0.0;
      continue;
    }
    if (two_shapes && !shapes.is_corner(v[0])) {
      pair.weight = 0.0;
      continue;
    }
    if (two_shapes) pair.shape = shapes.shape(v);
    for (int k = 1; k <= 3; ++k) {
      const int a = v[k], b = v[k % 3 + 1];
      (two_shapes ? face_edges : edges).add(v[0], a, b);
      (two_shapes ? face_corners : corners).add(v[0], a, a);
    }
  }
  if (mesh.objects.size() > 1) std::erase_if(pairs, [](const ContactPair& pair) { return pair.weight == 0.0; });
  const auto none = [](int, int) { return std::uint8_t{0}; };
  const auto of_face = [&](int a, int b) { return shapes.shape(a, b); };
  edges.append_to(pairs, mesh.num_vertices(), -1.0, none);
  corners.append_to(pairs, mesh.num_vertices(), 1.0, none);
  face_edges.append_to(pairs, mesh.num_vertices(), -1.0, of_face);
  face_corners.append_to(pairs, mesh.num_vertices(), 1.0, of_face);
  shapes.append_to(pairs);
  return with_laws(std::move(pairs));
}

}  // namespace tacipc
