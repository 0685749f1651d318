#include "common/mesh/scene_parts.h"

#include "common/base/error.h"

namespace tacipc {

TriangleMesh joined_parts(std::span<const PlacedPart> parts, const std::string& name) {
  std::size_t vertices = 0, triangles = 0;
  for (const PlacedPart& part : parts) {
    vertices += part.mesh->vertices.size();
    triangles += part.mesh->triangles.size();
    if (vertices > kMostSceneElements || triangles > kMostSceneElements)
      throw DataError("{}: has more than {} {}", name, kMostSceneElements,
                      vertices > kMostSceneElements ? "vertices" : "triangles");
  }
  if (triangles == 0) throw DataError("{}: has no triangles", name);
  TriangleMesh mesh;
  mesh.positions.resize(static_cast<Eigen::Index>(vertices), 3);
  mesh.triangles.resize(static_cast<Eigen::Index>(triangles), 3);
  Eigen::Index v = 0, f = 0;
  for (const PlacedPart& part : parts) {
    const int first = static_cast<int>(v);
    const bool mirrored = part.scene_from_part.linear().determinant() < 0.0;
    for (const Eigen::Vector3i& triangle : part.mesh->triangles) {
      mesh.triangles.row(f) = triangle.transpose().array() + first;
      if (mirrored) std::swap(mesh.triangles(f, 1), mesh.triangles(f, 2));
      ++f;
    }
    for (const Vector3& vertex : part.mesh->vertices) {
      mesh.positions.row(v) = (part.scene_from_part * vertex).transpose();
      if (!mesh.positions.row(v).allFinite()) throw DataError("{}: vertex {} is not finite", name, v);
      ++v;
    }
  }
  return mesh;
}

}  // namespace tacipc
