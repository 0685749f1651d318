// Triangle meshes from lists, as tests and their shapes write them.
#pragma once

#include <array>
#include <vector>

#include "common/mesh/triangle_mesh.h"

namespace tacipc {

inline TriangleMesh make_mesh(const std::vector<Vector3>& vertices, const std::vector<std::array<int, 3>>& faces) {
  TriangleMesh mesh;
  mesh.positions.resize(std::ssize(vertices), 3);
  mesh.triangles.resize(std::ssize(faces), 3);
  for (std::size_t i = 0; i < vertices.size(); ++i) mesh.positions.row(static_cast<Eigen::Index>(i)) = vertices[i];
  for (std::size_t i = 0; i < faces.size(); ++i)
    mesh.triangles.row(static_cast<Eigen::Index>(i)) << faces[i][0], faces[i][1], faces[i][2];
  return mesh;
}

}  // namespace tacipc
