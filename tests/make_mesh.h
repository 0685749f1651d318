// Triangle meshes from lists, as tests and their shapes write them.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "common/mesh/triangle_mesh.h"

namespace tacipc {

inline TriangleMesh make_mesh(const std::vector<Vector3>& vertices, const std::vector<std::array<int, 3>>& faces) {
  return {rows_of<Positions>(vertices), rows_of<Triangles>(faces)};
}

/// A closed box between two corners, looking outwards.
inline TriangleMesh make_box(const Vector3& low, const Vector3& high) {
  const double a = low.x(), b = low.y(), c = low.z(), x = high.x(), y = high.y(), z = high.z();
  return make_mesh({{a, b, c}, {x, b, c}, {x, y, c}, {a, y, c}, {a, b, z}, {x, b, z}, {x, y, z}, {a, y, z}},
                   {{0, 2, 1},
                    {0, 3, 2},
                    {4, 5, 6},
                    {4, 6, 7},
                    {0, 1, 5},
                    {0, 5, 4},
                    {1, 2, 6},
                    {1, 6, 5},
                    {2, 3, 7},
                    {2, 7, 6},
                    {3, 0, 4},
                    {3, 4, 7}});
}

/// A closed L lying on z = 0, one high: [0, 3] × [0, 1] and [0, 1] × [1, 2].
inline TriangleMesh make_l_shape() {
  const std::array<Eigen::Vector2d, 6> outline{{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {0, 2}}};
  std::vector<Vector3> vertices;
  for (const double z : {0.0, 1.0})
    for (const Eigen::Vector2d& p : outline) vertices.emplace_back(p.x(), p.y(), z);
  std::vector<std::array<int, 3>> faces;
  for (const auto& [a, b, c] : std::vector<std::array<int, 3>>{{0, 1, 2}, {0, 2, 3}, {0, 3, 5}, {3, 4, 5}}) {
    faces.push_back({a, c, b});
    faces.push_back({a + 6, b + 6, c + 6});
  }
  for (int i = 0; i < 6; ++i) {
    const int next = (i + 1) % 6;
    faces.push_back({i, next, next + 6});
    faces.push_back({i, next + 6, i + 6});
  }
  return make_mesh(vertices, faces);
}

/// Octahedron whose faces are split in four `levels` times, all vertices on the sphere.
inline TriangleMesh sphere(double radius_m, int levels) {
  std::vector<Vector3> vertices{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  std::vector<std::array<int, 3>> faces{{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                        {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [found, fresh] = middles.try_emplace(std::minmax(a, b), static_cast<int>(vertices.size()));
      if (fresh) {
        const Vector3 sum = vertices[a] + vertices[b];
        vertices.push_back(sum / sum.norm());
      }
      return found->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : faces) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    faces = std::move(finer);
  }
  for (Vector3& vertex : vertices) vertex *= radius_m;
  return make_mesh(vertices, faces);
}

}  // namespace tacipc
