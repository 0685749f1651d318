#include "stages/gel/press/contact/contact_mesh.h"

#include <algorithm>

#include "stages/gel/press/contact/sharpness.h"

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

ContactMesh make_contact_mesh(const Positions& gel_rest, const Triangles& gel_boundary, const Positions& object,
                              const Triangles& object_triangles) {
  ContactMesh mesh;
  mesh.num_gel_vertices = static_cast<int>(gel_rest.rows());
  mesh.num_object_vertices = static_cast<int>(object.rows());
  mesh.gel = make_surface(gel_boundary, 0);
  mesh.object = make_surface(object_triangles, mesh.num_gel_vertices);
  mesh.rest_positions.resize(mesh.num_vertices(), 3);
  mesh.rest_positions << gel_rest, object;
  mesh.object_edge_sharpness = edge_sharpness(mesh.object, mesh.rest_positions);
  return mesh;
}

}  // namespace tacipc
