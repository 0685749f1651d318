// The same box with its faces cut into triangles in different ways.
#pragma once

#include <array>
#include <vector>

#include "tests/make_mesh.h"

namespace tacipc {

/// How the upper and lower face are cut: by one diagonal or the other, into a fan about a point near one corner, or
/// into a grid of squares. The last two have vertices along their edges.
enum class Cut { diagonal, other_diagonal, fan, grid };

/// A box around the origin. \param n pieces of each edge
inline TriangleMesh cut_box(const Vector3& half_m, Cut cut, int n = 8) {
  if (cut == Cut::diagonal || cut == Cut::other_diagonal) n = 1;
  const double a = half_m.x(), b = half_m.y();
  std::vector<Eigen::Vector2d> points;  // of a face: first those around it
  const auto part = [n](int i) { return 2.0 * i / n - 1.0; };
  for (int i = 0; i < n; ++i) points.emplace_back(a * part(i), -b);
  for (int i = 0; i < n; ++i) points.emplace_back(a, b * part(i));
  for (int i = 0; i < n; ++i) points.emplace_back(-a * part(i), b);
  for (int i = 0; i < n; ++i) points.emplace_back(-a, -b * part(i));
  const int around = 4 * n;
  std::vector<std::array<int, 3>> face;  // seen from above
  if (cut == Cut::fan) {
    points.emplace_back(-0.95 * a, -0.93 * b);
    for (int i = 0; i < around; ++i) face.push_back({around, i, (i + 1) % around});
  } else if (cut == Cut::grid) {
    for (int j = 1; j < n; ++j)
      for (int i = 1; i < n; ++i) points.emplace_back(a * part(i), b * part(j));
    const auto at = [n, around](int i, int j) {
      return j == 0   ? i
             : i == n ? n + j
             : j == n ? 3 * n - i
             : i == 0 ? (around - j) % around
                      : around + (j - 1) * (n - 1) + i - 1;
    };
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        face.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
        face.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    }
  } else {
    const int first = cut == Cut::diagonal ? 0 : 1;
    face = {{first, first + 1, first + 2}, {first, first + 2, (first + 3) % 4}};
  }
  const int count = static_cast<int>(points.size());
  std::vector<Vector3> vertices;
  for (const double z : {-half_m.z(), half_m.z()})
    for (const Eigen::Vector2d& p : points) vertices.emplace_back(p.x(), p.y(), z);
  std::vector<std::array<int, 3>> faces;
  for (const auto& [u, v, w] : face) {
    faces.push_back({u, w, v});
    faces.push_back({u + count, v + count, w + count});
  }
  for (int i = 0; i < around; ++i) {
    const int next = (i + 1) % around;
    faces.push_back({i, next, next + count});
    faces.push_back({i, next + count, i + count});
  }
  return make_mesh(vertices, faces);
}

}  // namespace tacipc
