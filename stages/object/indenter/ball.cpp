#include "stages/object/indenter/ball.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <vector>

#include "common/base/error.h"

namespace tacipc {
namespace {

using Corners = std::array<int, 3>;

/// Convex hull of (0, ±1, ±φ) and its cyclic permutations: all triples of vertices two apart, oriented outwards.
void icosahedron(std::vector<Vector3>& vertices, std::vector<Corners>& faces) {
  const double phi = (1.0 + std::sqrt(5.0)) / 2.0;
  for (int axis = 0; axis < 3; ++axis)
    for (const double a : {-1.0, 1.0})
      for (const double b : {-phi, phi}) {
        Vector3 v = Vector3::Zero();
        v[(axis + 1) % 3] = a;
        v[(axis + 2) % 3] = b;
        vertices.push_back(v);
      }
  const auto adjacent = [&](int i, int j) { return std::abs((vertices[i] - vertices[j]).norm() - 2.0) < 1e-9; };
  for (int i = 0; i < 12; ++i)
    for (int j = i + 1; j < 12; ++j)
      for (int k = j + 1; k < 12; ++k) {
        if (!adjacent(i, j) || !adjacent(j, k) || !adjacent(i, k)) continue;
        const auto& [a, b, c] = std::tie(vertices[i], vertices[j], vertices[k]);
        if (a.dot(b.cross(c)) > 0.0)
          faces.push_back({i, j, k});
        else
          faces.push_back({i, k, j});
      }
  for (Vector3& v : vertices) v.normalize();
}

void split(std::vector<Vector3>& vertices, std::vector<Corners>& faces) {
  std::map<std::array<int, 2>, int> middle_of;
  const auto middle = [&](int i, int j) {
    const auto [place, fresh] =
        middle_of.try_emplace({std::min(i, j), std::max(i, j)}, static_cast<int>(vertices.size()));
    if (fresh) vertices.push_back((vertices[i] + vertices[j]).normalized());
    return place->second;
  };
  std::vector<Corners> finer;
  for (const auto& [a, b, c] : faces) {
    const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
  }
  faces = std::move(finer);
}

}  // namespace

TriangleMesh ball_mesh(double radius_m, double edge_m) {
  constexpr int kMaxSplits = 8;
  std::vector<Vector3> vertices;
  std::vector<Corners> faces;
  icosahedron(vertices, faces);
  const auto longest = [&] {
    double length = 0.0;
    for (const Corners& f : faces)
      for (std::size_t i = 0; i < 3; ++i) length = std::max(length, (vertices[f[i]] - vertices[f[(i + 1) % 3]]).norm());
    return radius_m * length;
  };
  for (int splits = 0; longest() > edge_m; ++splits) {
    if (splits == kMaxSplits)
      throw DataError("a ball with edges of {} m needs more than {} splits", edge_m, kMaxSplits);
    split(vertices, faces);
  }
  return {radius_m * rows_of<Positions>(vertices), rows_of<Triangles>(faces)};
}

}  // namespace tacipc
