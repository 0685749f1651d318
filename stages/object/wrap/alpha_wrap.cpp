#include "stages/object/wrap/alpha_wrap.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>

#include <array>
#include <vector>

#include "common/base/error.h"

namespace tacipc {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Surface = CGAL::Surface_mesh<Point>;

struct Soup {
  std::vector<Point> points;
  std::vector<std::array<std::size_t, 3>> faces;
};

/// Triangle soup without faces of zero area: only their edges could be touched, and these belong to other faces.
Soup soup_of(const TriangleMesh& mesh) {
  Soup soup;
  soup.points.reserve(mesh.num_vertices());
  for (Eigen::Index v = 0; v < mesh.num_vertices(); ++v)
    soup.points.emplace_back(mesh.positions(v, 0), mesh.positions(v, 1), mesh.positions(v, 2));
  for (Eigen::Index f = 0; f < mesh.num_triangles(); ++f) {
    const std::array<std::size_t, 3> face{static_cast<std::size_t>(mesh.triangles(f, 0)),
                                          static_cast<std::size_t>(mesh.triangles(f, 1)),
                                          static_cast<std::size_t>(mesh.triangles(f, 2))};
    if (!CGAL::collinear(soup.points[face[0]], soup.points[face[1]], soup.points[face[2]])) soup.faces.push_back(face);
  }
  return soup;
}

TriangleMesh mesh_of(const Surface& surface) {
  TriangleMesh mesh;
  mesh.positions.resize(surface.number_of_vertices(), 3);
  mesh.triangles.resize(surface.number_of_faces(), 3);
  for (const auto vertex : surface.vertices()) {
    const Point& point = surface.point(vertex);
    mesh.positions.row(vertex.idx()) << point.x(), point.y(), point.z();
  }
  for (const auto face : surface.faces()) {
    int corner = 0;
    for (const auto vertex : CGAL::vertices_around_face(surface.halfedge(face), surface))
      mesh.triangles(face.idx(), corner++) = static_cast<int>(vertex.idx());
  }
  return mesh;
}

}  // namespace

TriangleMesh alpha_wrap(const TriangleMesh& mesh, double alpha_m, double offset_m) {
  const Soup soup = soup_of(mesh);
  if (soup.faces.empty()) throw DataError("the mesh has no face with an area");
  Surface surface;
  try {
    CGAL::alpha_wrap_3(soup.points, soup.faces, alpha_m, offset_m, surface);
  } catch (const CGAL::Failure_exception& failure) {
    throw DataError("CGAL cannot wrap the mesh ({})", failure.message());
  }
  // CGAL warns about a surface that it cannot extract, and leaves it empty.
  if (surface.is_empty()) throw DataError("CGAL finds no closed surface around the mesh");
  return mesh_of(surface);
}

}  // namespace tacipc
