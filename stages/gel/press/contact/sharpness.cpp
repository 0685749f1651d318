#include "stages/gel/press/contact/sharpness.h"

#include <algorithm>

namespace tacipc {

std::size_t index_of_edge(const Surface& surface, int a, int b) {
  const std::array<int, 2> edge{std::min(a, b), std::max(a, b)};
  return static_cast<std::size_t>(std::lower_bound(surface.edges.begin(), surface.edges.end(), edge) -
                                  surface.edges.begin());
}

std::vector<double> edge_sharpness(const Surface& surface, const Positions& positions) {
  struct Side {
    Vector3 normal;
    int opposite;
  };
  const auto at = [&](int v) -> Vector3 { return positions.row(v).transpose(); };
  std::vector<std::vector<Side>> sides(surface.edges.size());
  for (const auto& t : surface.triangles) {
    const Vector3 normal = (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0])).stableNormalized();
    for (int k = 0; k < 3; ++k) sides[index_of_edge(surface, t[k], t[(k + 1) % 3])].push_back({normal, t[(k + 2) % 3]});
  }
  std::vector<double> sharpness(surface.edges.size(), 1.0);
  for (std::size_t e = 0; e < sides.size(); ++e) {
    if (sides[e].size() != 2) continue;
    const auto& [one, other] = std::pair(sides[e][0], sides[e][1]);
    const bool outwards = one.normal.dot(at(other.opposite) - at(surface.edges[e][0])) < 0.0;
    sharpness[e] = outwards ? std::clamp(1.0 - one.normal.dot(other.normal), 0.0, 1.0) : 0.0;
  }
  return sharpness;
}

}  // namespace tacipc
