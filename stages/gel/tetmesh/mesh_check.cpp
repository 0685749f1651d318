#include "stages/gel/tetmesh/mesh_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "common/base/error.h"
#include "common/mesh/exact_predicates.h"

namespace tacipc {
namespace {

std::array<Vector3, 4> corners(const TetMesh& mesh, Eigen::Index t) {
  return {mesh.positions.row(mesh.tets(t, 0)), mesh.positions.row(mesh.tets(t, 1)), mesh.positions.row(mesh.tets(t, 2)),
          mesh.positions.row(mesh.tets(t, 3))};
}

/// A triangle rotated so that its smallest vertex comes first; its orientation is unchanged.
std::array<int, 3> rotated(const Eigen::RowVector3i& triangle) {
  int first = 0;
  triangle.minCoeff(&first);
  return {triangle[first], triangle[(first + 1) % 3], triangle[(first + 2) % 3]};
}

std::vector<std::array<int, 3>> sorted_triangles(const Triangles& triangles) {
  std::vector<std::array<int, 3>> sorted;
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) sorted.push_back(rotated(triangles.row(f)));
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

void check_tets(const TetMesh& mesh, double min_dihedral_deg, const std::string& name) {
  std::vector<bool> used(static_cast<std::size_t>(mesh.num_vertices()), false);
  double worst = 180.0;
  Eigen::Index worst_tet = 0;
  for (Eigen::Index t = 0; t < mesh.num_tets(); ++t) {
    const auto x = corners(mesh, t);
    if (orient3d(x[0], x[1], x[2], x[3]) <= 0) throw DataError("{}: tet {} has no positive volume", name, t);
    const double smallest = dihedral_angles(x[0], x[1], x[2], x[3]).smallest_deg;
    if (smallest < worst) {
      worst = smallest;
      worst_tet = t;
    }
    for (int i = 0; i < 4; ++i) used[static_cast<std::size_t>(mesh.tets(t, i))] = true;
  }
  if (worst < min_dihedral_deg) {
    throw DataError("{}: tet {} has a dihedral angle of {:.3g} degrees, below the limit of {:g}", name, worst_tet,
                    worst, min_dihedral_deg);
  }
  const auto unused = std::count(used.begin(), used.end(), false);
  if (unused > 0) {
    throw DataError("{}: {} of {} vertices belong to no tet, the first is vertex {}", name, unused, used.size(),
                    std::find(used.begin(), used.end(), false) - used.begin());
  }
}

/// Checks that no tetrahedra overlap: positive neighbours see their common face with opposite orientations.
void check_overlap(const TetMesh& mesh, const std::string& name) {
  constexpr std::array<std::array<int, 3>, 4> kFaces{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
  std::vector<std::array<int, 3>> faces;
  faces.reserve(static_cast<std::size_t>(4 * mesh.num_tets()));
  for (Eigen::Index t = 0; t < mesh.num_tets(); ++t)
    for (const auto& f : kFaces) faces.push_back(rotated({mesh.tets(t, f[0]), mesh.tets(t, f[1]), mesh.tets(t, f[2])}));
  std::sort(faces.begin(), faces.end());
  const auto twice = std::adjacent_find(faces.begin(), faces.end());
  if (twice != faces.end()) {
    throw DataError("{}: two tets lie on the same side of the face of vertices {}, {}, {}", name, (*twice)[0],
                    (*twice)[1], (*twice)[2]);
  }
}

void check_boundary(const TetMesh& mesh, const std::string& name) {
  if (sorted_triangles(mesh.boundary) != sorted_triangles(boundary_triangles(mesh.tets, mesh.num_vertices()))) {
    throw DataError("{}: the tagged triangles are not the boundary of the tets", name);
  }
  std::vector<std::array<int, 2>> edges;
  for (Eigen::Index f = 0; f < mesh.boundary.rows(); ++f)
    for (int e = 0; e < 3; ++e) {
      const int i = mesh.boundary(f, e), j = mesh.boundary(f, (e + 1) % 3);
      edges.push_back({std::min(i, j), std::max(i, j)});
    }
  std::sort(edges.begin(), edges.end());
  for (std::size_t first = 0; first < edges.size();) {
    std::size_t last = first;
    while (last < edges.size() && edges[last] == edges[first]) ++last;
    if (last - first != 2) {
      throw DataError("{}: {} boundary triangles meet at the edge of vertices {} and {}", name, last - first,
                      edges[first][0], edges[first][1]);
    }
    first = last;
  }
}

void check_front(const TetMesh& mesh, const GelShape& gel, double tolerance_m, const std::string& name) {
  for (const int v : mesh.vertices(BoundaryTag::front)) {
    const Vector3 x = mesh.positions.row(v);
    const double off = std::abs(x.z() - gel.front_z(x.x(), x.y()));
    if (!(off <= tolerance_m)) {
      throw DataError("{}: front vertex {} lies {:.3g} mm off the sensor's front face, more than {:g} mm", name, v,
                      1e3 * off, 1e3 * tolerance_m);
    }
  }
}

}  // namespace

DihedralAngles dihedral_angles(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  // Outward normals; the angle inside between two faces is π minus that between their normals.
  const std::array<Vector3, 4> normals{(c - b).cross(d - b), (d - a).cross(c - a), (b - a).cross(d - a),
                                       (c - a).cross(b - a)};
  DihedralAngles angles{180.0, 0.0};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < i; ++j) {
      const double between = std::atan2(normals[i].cross(normals[j]).norm(), normals[i].dot(normals[j]));
      const double inside = 180.0 - between * 180.0 / std::numbers::pi;
      angles.smallest_deg = std::min(angles.smallest_deg, inside);
      angles.largest_deg = std::max(angles.largest_deg, inside);
    }
  return angles;
}

void check_faces(const TetMesh& mesh, const std::string& name) {
  for (const auto& [tag, word] : {std::pair{BoundaryTag::front, "front"}, std::pair{BoundaryTag::side, "side"},
                                  std::pair{BoundaryTag::glued, "glued"}}) {
    if (std::find(mesh.tags.begin(), mesh.tags.end(), tag) == mesh.tags.end()) {
      throw DataError("{}: no boundary triangle belongs to the {} face", name, word);
    }
  }
}

void check_body(const TetMesh& mesh, double min_dihedral_deg, const std::string& name) {
  if (mesh.num_tets() == 0) throw DataError("{}: has no tets", name);
  check_tets(mesh, min_dihedral_deg, name);
  check_overlap(mesh, name);
  check_boundary(mesh, name);
}

void check_gel(const TetMesh& mesh, const GelShape& gel, const MeshLimits& limits, const std::string& name) {
  check_body(mesh, limits.min_dihedral_deg, name);
  check_faces(mesh, name);
  check_front(mesh, gel, limits.front_tolerance_m, name);
}

}  // namespace tacipc
