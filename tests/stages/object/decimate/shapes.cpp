#include "tests/stages/object/decimate/shapes.h"

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

namespace tacipc {

TriangleMesh cube(double size_m, int n) {
  std::map<std::array<int, 3>, int> index;
  std::vector<Vector3> vertices;
  std::vector<std::array<int, 3>> faces;
  const auto vertex = [&](std::array<int, 3> at) {
    const auto [found, fresh] = index.try_emplace(at, static_cast<int>(vertices.size()));
    if (fresh) vertices.push_back(Vector3(at[0], at[1], at[2]) * (size_m / n));
    return found->second;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {0, n})
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const auto at = [&](int u, int v) {
            std::array<int, 3> p{};
            p[axis] = side;
            p[(axis + 1) % 3] = u;
            p[(axis + 2) % 3] = v;
            return vertex(p);
          };
          const int a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
          if (side == 0) {
            faces.push_back({a, c, b});
            faces.push_back({a, d, c});
          } else {
            faces.push_back({a, b, c});
            faces.push_back({a, c, d});
          }
        }
  return make_mesh(vertices, faces);
}

TriangleMesh bumpy_torus(double ring_m, double tube_m, double bump, int nu, int nv) {
  std::vector<Vector3> vertices;
  std::vector<std::array<int, 3>> faces;
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) {
      const double u = 2 * std::numbers::pi * i / nu, v = 2 * std::numbers::pi * j / nv;
      const double tube = tube_m * (1 + bump * std::sin(12 * u) * std::sin(7 * v));
      const double r = ring_m + tube * std::cos(v);
      vertices.emplace_back(r * std::cos(u), r * std::sin(u), tube * std::sin(v));
      const auto at = [&](int p, int q) { return (p % nu) * nv + q % nv; };
      faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return make_mesh(vertices, faces);
}

TriangleMesh joined(const TriangleMesh& first, const TriangleMesh& second) {
  TriangleMesh mesh;
  mesh.positions.resize(first.num_vertices() + second.num_vertices(), 3);
  mesh.positions << first.positions, second.positions;
  mesh.triangles.resize(first.num_triangles() + second.num_triangles(), 3);
  mesh.triangles << first.triangles, (second.triangles.array() + static_cast<int>(first.num_vertices())).matrix();
  return mesh;
}

TriangleMesh moved(TriangleMesh mesh, const Vector3& by_m) {
  mesh.positions.rowwise() += by_m.transpose();
  return mesh;
}

TriangleMesh without_faces(const TriangleMesh& mesh, const std::vector<int>& faces) {
  const std::set<int> gone(faces.begin(), faces.end());
  TriangleMesh rest{mesh.positions, Triangles(mesh.num_triangles() - std::ssize(gone), 3)};
  Eigen::Index next = 0;
  for (int f = 0; f < static_cast<int>(mesh.num_triangles()); ++f)
    if (!gone.contains(f)) rest.triangles.row(next++) = mesh.triangles.row(f);
  return rest;
}

TriangleMesh with_face(const TriangleMesh& mesh, const std::array<int, 3>& face) {
  TriangleMesh more = mesh;
  more.triangles.conservativeResize(mesh.num_triangles() + 1, 3);
  more.triangles.row(mesh.num_triangles()) << face[0], face[1], face[2];
  return more;
}

TriangleMesh with_face_turned(TriangleMesh mesh, int face) {
  std::swap(mesh.triangles(face, 0), mesh.triangles(face, 1));
  return mesh;
}

bool is_closed_manifold(const TriangleMesh& mesh) {
  // Directed edge → the corner opposite to it: each once, each with its reverse.
  std::map<std::pair<int, int>, int> apex;
  for (Eigen::Index f = 0; f < mesh.num_triangles(); ++f)
    for (int k = 0; k < 3; ++k)
      if (!apex.try_emplace({mesh.triangles(f, k), mesh.triangles(f, (k + 1) % 3)}, mesh.triangles(f, (k + 2) % 3))
               .second)
        return false;
  std::vector<int> valence(static_cast<std::size_t>(mesh.num_vertices()), 0);
  std::vector<int> start(valence.size(), -1);
  for (const auto& [edge, corner] : apex) {
    if (!apex.contains({edge.second, edge.first})) return false;
    ++valence[edge.first];
    start[edge.first] = edge.second;
  }
  for (int v = 0; v < static_cast<int>(valence.size()); ++v) {
    if (valence[v] < 3) return false;
    int turns = 0, at = start[v];
    do {
      at = apex.at({v, at});
      ++turns;
    } while (at != start[v] && turns <= valence[v]);
    if (turns != valence[v]) return false;
  }
  return true;
}

}  // namespace tacipc
