#include "stages/object/decimate/surface_topology.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "common/base/error.h"

namespace tacipc {

std::vector<EdgeUse> edge_uses(const Triangles& triangles) {
  std::vector<EdgeUse> uses(3 * triangles.rows());
  for (int h = 0; h < static_cast<int>(uses.size()); ++h) {
    const auto [low, high] = std::minmax({origin_of(triangles, h), target_of(triangles, h)});
    uses[h] = {low, high, h};
  }
  std::ranges::sort(uses, [](const EdgeUse& a, const EdgeUse& b) {
    if (a.low != b.low) return a.low < b.low;
    return a.high != b.high ? a.high < b.high : a.half_edge < b.half_edge;
  });
  return uses;
}

void pair_up(int a, int b, std::vector<int>& opposite) { opposite[a] = b, opposite[b] = a; }

std::vector<int> opposite_half_edges(const TriangleMesh& mesh) {
  const std::vector<EdgeUse> uses = edge_uses(mesh.triangles);
  std::vector<int> opposite(uses.size(), kOpen);
  for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
    if (edge.size() > 2) {
      const Eigen::RowVector3d middle = 0.5 * (mesh.positions.row(edge[0].low) + mesh.positions.row(edge[0].high));
      throw DataError("non-manifold mesh: {} faces share the edge near {}", edge.size(), place_mm(middle));
    }
    if (edge.size() == 2) pair_up(edge[0].half_edge, edge[1].half_edge, opposite);
  });
  return opposite;
}

Components connected_components(const Triangles& triangles, const std::vector<int>& opposite) {
  const int num_faces = static_cast<int>(triangles.rows());
  Components components{.of_face = std::vector<int>(static_cast<std::size_t>(num_faces), -1), .count = 0};
  std::vector<int> queue;
  for (int seed = 0; seed < num_faces; ++seed) {
    if (components.of_face[seed] >= 0) continue;
    components.of_face[seed] = components.count;
    queue.assign(1, seed);
    while (!queue.empty()) {
      const int face = queue.back();
      queue.pop_back();
      for (int k = 0; k < 3; ++k) {
        const int other = opposite[3 * face + k];
        if (other == kOpen || components.of_face[other / 3] >= 0) continue;
        components.of_face[other / 3] = components.count;
        queue.push_back(other / 3);
      }
    }
    ++components.count;
  }
  return components;
}

void append_faces(TriangleMesh& mesh, const std::vector<std::array<int, 3>>& faces) {
  mesh.triangles.conservativeResize(mesh.num_triangles() + std::ssize(faces), 3);
  mesh.triangles.bottomRows(std::ssize(faces)) = rows_of<Triangles>(faces);
}

Triangles select_faces(const Triangles& triangles, const std::vector<char>& keep) {
  Triangles kept(std::ranges::count(keep, 1), 3);
  Eigen::Index next = 0;
  for (Eigen::Index f = 0; f < triangles.rows(); ++f)
    if (keep[f] != 0) kept.row(next++) = triangles.row(f);
  return kept;
}

std::string place_mm(const Eigen::RowVector3d& point_m) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g}) mm", 1e3 * point_m[0], 1e3 * point_m[1], 1e3 * point_m[2]);
}

double largest_extent(const TriangleMesh& mesh) {
  if (mesh.num_triangles() == 0) return 0.0;
  Eigen::RowVector3d low = mesh.positions.row(mesh.triangles(0, 0)), high = low;
  for (Eigen::Index i = 0; i < mesh.triangles.size(); ++i) {
    low = low.cwiseMin(mesh.positions.row(mesh.triangles.data()[i]));
    high = high.cwiseMax(mesh.positions.row(mesh.triangles.data()[i]));
  }
  return (high - low).maxCoeff();
}

Vector3 corner(const TriangleMesh& mesh, int face, int k) {
  return mesh.positions.row(mesh.triangles(face, k)).transpose();
}

Vector3 area_vector(const TriangleMesh& mesh, int face) {
  const Vector3 a = corner(mesh, face, 0);
  return 0.5 * (corner(mesh, face, 1) - a).cross(corner(mesh, face, 2) - a);
}

double surface_area(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (int f = 0; f < static_cast<int>(mesh.num_triangles()); ++f) sum += area_vector(mesh, f).norm();
  return sum;
}

}  // namespace tacipc
