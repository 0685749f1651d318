#include "stages/gel/press/contact/pair_counting.h"

#include <algorithm>
#include <cstdint>

#include "stages/gel/press/contact/sharpness.h"

namespace tacipc {
namespace {

/// Edges or corners that vertices are near to, each by its lowest and highest vertex.
class PairCells {
 public:
  void add(int point, int a, int b) {
    points_.push_back(point);
    ends_.push_back(static_cast<std::uint64_t>(std::min(a, b)) << 32 | static_cast<std::uint64_t>(std::max(a, b)));
  }

  /// Each once, by vertex and then by its ends: the same however the triangles came.
  void append_to(std::vector<ContactPair>& pairs, int num_vertices, double weight) const {
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
        pairs.push_back({ContactPair::Kind::point_triangle, {p, low, high, high}, weight});
      }
    }
  }

 private:
  std::vector<int> points_;
  std::vector<std::uint64_t> ends_;
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
  PairCells edges, corners;
  for (ContactPair& pair : pairs) {
    const auto& v = pair.vertices;
    if (of_gel(v[0]) && of_gel(v[3]) && (mesh.gels.empty() || mesh.body_of(v[0]) == mesh.body_of(v[3]))) continue;
    if (pair.kind == Kind::edge_edge) {
      pair.weight = std::max({counting.edge_weight, sharpness(v[0], v[1]), sharpness(v[2], v[3])});
      continue;
    }
    for (int k = 1; k <= 3; ++k) {
      const int a = v[k], b = v[k % 3 + 1];
      edges.add(v[0], a, b);
      corners.add(v[0], a, a);
    }
  }
  edges.append_to(pairs, mesh.num_vertices(), -1.0);
  corners.append_to(pairs, mesh.num_vertices(), 1.0);
  return with_laws(std::move(pairs));
}

}  // namespace tacipc
