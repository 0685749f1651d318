#include "common/mesh/tet_mesh.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "common/base/error.h"

namespace tacipc {
namespace {

/// Faces of a positive tet, counter-clockwise seen from outside.
constexpr std::array<std::array<int, 3>, 4> kFaces{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

struct KeyedFace {
  std::uint64_t first_two;  // first two of its sorted vertices
  int third;
  int place;  // 4 · tet + face

  bool same_vertices(const KeyedFace& other) const { return first_two == other.first_two && third == other.third; }
};

}  // namespace

Triangles TetMesh::faces(BoundaryTag tag) const {
  Triangles found(boundary.rows(), 3);
  Eigen::Index count = 0;
  for (Eigen::Index f = 0; f < boundary.rows(); ++f)
    if (tags[f] == tag) found.row(count++) = boundary.row(f);
  found.conservativeResize(count, 3);
  return found;
}

std::vector<int> TetMesh::vertices(BoundaryTag tag) const {
  const Triangles of_tag = faces(tag);
  std::vector<int> found(of_tag.data(), of_tag.data() + of_tag.size());
  std::ranges::sort(found);
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

Triangles TetMesh::surface(BoundaryTag tag) const {
  const std::vector<int> all = vertices(tag);
  Triangles triangles = faces(tag);
  for (int& v : triangles.reshaped()) v = static_cast<int>(std::ranges::lower_bound(all, v) - all.begin());
  return triangles;
}

TetMesh joined(const std::vector<TetMesh>& meshes) {
  Eigen::Index vertices = 0, tets = 0, triangles = 0;
  for (const TetMesh& mesh : meshes) {
    vertices += mesh.num_vertices();
    tets += mesh.num_tets();
    triangles += mesh.boundary.rows();
  }
  TetMesh out{Positions(vertices, 3), Tetrahedra(tets, 4), Triangles(triangles, 3), {}};
  vertices = tets = triangles = 0;
  for (const TetMesh& mesh : meshes) {
    const auto first = static_cast<int>(vertices);
    out.positions.middleRows(vertices, mesh.num_vertices()) = mesh.positions;
    out.tets.middleRows(tets, mesh.num_tets()) = mesh.tets.array() + first;
    out.boundary.middleRows(triangles, mesh.boundary.rows()) = mesh.boundary.array() + first;
    out.tags.insert(out.tags.end(), mesh.tags.begin(), mesh.tags.end());
    vertices += mesh.num_vertices();
    tets += mesh.num_tets();
    triangles += mesh.boundary.rows();
  }
  return out;
}

Triangles boundary_triangles(const Tetrahedra& tets, Eigen::Index num_vertices) {
  std::vector<KeyedFace> faces;
  faces.reserve(4 * tets.rows());
  for (Eigen::Index t = 0; t < tets.rows(); ++t)
    for (int f = 0; f < 4; ++f) {
      std::array<int, 3> key;
      for (int i = 0; i < 3; ++i) {
        key[i] = tets(t, kFaces[f][i]);
        if (key[i] < 0 || key[i] >= num_vertices)
          throw DataError("tet {} refers to vertex {}, but there are {} vertices", t, key[i], num_vertices);
      }
      std::ranges::sort(key);
      faces.push_back({static_cast<std::uint64_t>(key[0]) << 32U | static_cast<std::uint64_t>(key[1]), key[2],
                       static_cast<int>(4 * t + f)});
    }
  std::ranges::sort(faces, [](const KeyedFace& a, const KeyedFace& b) {
    if (a.first_two != b.first_two) return a.first_two < b.first_two;
    return a.third != b.third ? a.third < b.third : a.place < b.place;
  });
  std::vector<int> single;
  for (std::size_t first = 0; first < faces.size();) {
    std::size_t last = first + 1;
    while (last < faces.size() && faces[last].same_vertices(faces[first])) ++last;
    if (last - first > 2)
      throw DataError("{} tets share the face of vertices {}, {}, {}", last - first, faces[first].first_two >> 32U,
                      faces[first].first_two & 0xffffffffU, faces[first].third);
    if (last - first == 1) single.push_back(faces[first].place);
    first = last;
  }
  std::ranges::sort(single);
  Triangles boundary(single.size(), 3);
  for (std::size_t b = 0; b < single.size(); ++b)
    for (int i = 0; i < 3; ++i) boundary(b, i) = tets(single[b] / 4, kFaces[single[b] % 4][i]);
  return boundary;
}

}  // namespace tacipc
