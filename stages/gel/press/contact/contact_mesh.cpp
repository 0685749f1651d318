#include "stages/gel/press/contact/contact_mesh.h"

#include "stages/gel/press/contact/sharpness.h"

namespace tacipc {

int ContactMesh::body_of(int vertex) const {
  // A linear search suffices: there are few parts.
  const auto last_from = [&](const auto& parts) {
    std::size_t i = 0;
    while (i + 1 < parts.size() && vertex >= parts[i + 1].first_vertex) ++i;
    return static_cast<int>(i);
  };
  return vertex < num_gel_vertices ? last_from(gels) : num_gels() + last_from(objects);
}

ContactMesh make_contact_mesh(const Positions& gel_rest, const Triangles& gel_boundary,
                              const std::vector<TriangleMesh>& objects) {
  ContactMesh mesh;
  mesh.num_gel_vertices = static_cast<int>(gel_rest.rows());
  mesh.gel = make_surface(gel_boundary, 0);
  for (const TriangleMesh& object : objects) {
    const int first = mesh.num_vertices();
    ObjectPart part{first, make_surface(object.triangles, first)};
    const auto append = [](auto& all, const auto& some) { all.insert(all.end(), some.begin(), some.end()); };
    append(mesh.object.vertices, part.surface.vertices);
    append(mesh.object.edges, part.surface.edges);
    append(mesh.object.triangles, part.surface.triangles);
    // Vertices without a triangle count as well: rows of positions are those of the file.
    part.num_vertices = static_cast<int>(object.positions.rows());
    mesh.num_object_vertices += part.num_vertices;
    mesh.objects.push_back(std::move(part));
  }
  mesh.rest_positions.resize(mesh.num_vertices(), 3);
  mesh.rest_positions.topRows(mesh.num_gel_vertices) = gel_rest;
  for (std::size_t i = 0; i < objects.size(); ++i) mesh.objects[i].rows(mesh.rest_positions) = objects[i].positions;
  mesh.object_edge_sharpness = edge_sharpness(mesh.object, mesh.rest_positions);
  if (mesh.objects.size() > 1) mesh.object_shapes = shape_features(mesh.object, mesh.rest_positions);
  return mesh;
}

}  // namespace tacipc
