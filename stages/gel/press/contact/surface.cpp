#include "stages/gel/press/contact/surface.h"

#include <algorithm>

namespace tacipc {
namespace {

template <typename T>
void sort_unique(std::vector<T>& items) {
  std::sort(items.begin(), items.end());
  items.erase(std::unique(items.begin(), items.end()), items.end());
}

}  // namespace

Surface make_surface(const Triangles& triangles, int offset) {
  Surface surface;
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    const std::array<int, 3> corner{triangles(f, 0) + offset, triangles(f, 1) + offset, triangles(f, 2) + offset};
    surface.triangles.push_back(corner);
    for (int k = 0; k < 3; ++k) {
      surface.vertices.push_back(corner[k]);
      surface.edges.push_back({std::min(corner[k], corner[(k + 1) % 3]), std::max(corner[k], corner[(k + 1) % 3])});
    }
  }
  sort_unique(surface.vertices);
  sort_unique(surface.edges);
  return surface;
}

}  // namespace tacipc
