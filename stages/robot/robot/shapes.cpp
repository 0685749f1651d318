#include "stages/robot/robot/shapes.h"

#include <cmath>
#include <numbers>
#include <vector>

namespace tacipc {
namespace {

constexpr int kAround = 24, kRings = 6;  // facets of round shapes
constexpr int kFirstHiddenGroup = 3;

/// Points of one shape in its own frame, and triangles that face outwards.
struct Facets {
  std::vector<Vector3> points;
  std::vector<Eigen::Vector3i> triangles;
};

Facets box(const Vector3& half) {
  Facets all;
  for (int i = 0; i < 8; ++i)
    all.points.emplace_back((i & 1 ? 1 : -1) * half.x(), (i & 2 ? 1 : -1) * half.y(), (i & 4 ? 1 : -1) * half.z());
  for (const auto& [a, b, c, d] :
       {std::array{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    all.triangles.emplace_back(a, b, c);
    all.triangles.emplace_back(a, c, d);
  }
  return all;
}

/// Returns a surface of revolution about z through rings of (radius, z), from bottom to top.
Facets turned(const std::vector<Eigen::Vector2d>& rings) {
  Facets all;
  for (const Eigen::Vector2d& ring : rings) {
    for (int k = 0; k < kAround; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kAround;
      all.points.emplace_back(ring.x() * std::cos(angle), ring.x() * std::sin(angle), ring.y());
    }
  }
  for (int r = 0; r + 1 < static_cast<int>(rings.size()); ++r) {
    for (int k = 0; k < kAround; ++k) {
      const int a = r * kAround + k, b = r * kAround + (k + 1) % kAround;
      all.triangles.emplace_back(a, b, b + kAround);
      all.triangles.emplace_back(a, b + kAround, a + kAround);
    }
  }
  return all;
}

Facets capsule(double radius, double half_length) {
  std::vector<Eigen::Vector2d> rings;
  for (int r = 0; r <= 2 * kRings + 1; ++r) {
    const bool upper = r > kRings;
    const double angle = std::numbers::pi * ((upper ? r - 1 : r) / (2.0 * kRings) - 0.5);
    rings.emplace_back(radius * std::cos(angle), radius * std::sin(angle) + (upper ? half_length : -half_length));
  }
  return turned(rings);
}

Facets of_geom(const mjModel& m, int g) {
  const mjtNum* size = m.geom_size + 3 * g;
  switch (m.geom_type[g]) {
    case mjGEOM_BOX: return box({size[0], size[1], size[2]});
    case mjGEOM_SPHERE: return capsule(size[0], 0.0);
    case mjGEOM_CAPSULE: return capsule(size[0], size[1]);
    case mjGEOM_CYLINDER: return turned({{0.0, -size[1]}, {size[0], -size[1]}, {size[0], size[1]}, {0.0, size[1]}});
    case mjGEOM_ELLIPSOID: {
      Facets all = capsule(1.0, 0.0);
      for (Vector3& p : all.points) p = p.cwiseProduct(Vector3(size[0], size[1], size[2]));
      return all;
    }
    case mjGEOM_MESH: {
      Facets all;
      const int mesh = m.geom_dataid[g];
      for (int v = 0; v < m.mesh_vertnum[mesh]; ++v) {
        const float* p = m.mesh_vert + 3 * (m.mesh_vertadr[mesh] + v);
        all.points.emplace_back(p[0], p[1], p[2]);
      }
      for (int f = 0; f < m.mesh_facenum[mesh]; ++f) {
        const int* t = m.mesh_face + 3 * (m.mesh_faceadr[mesh] + f);
        all.triangles.emplace_back(t[0], t[1], t[2]);
      }
      return all;
    }
    default: return {};
  }
}

}  // namespace

TriangleMesh shape_of_body(const mjModel& m, int body) {
  Facets all;
  for (int i = 0; i < m.body_geomnum[body]; ++i) {
    const int g = m.body_geomadr[body] + i;
    if (m.geom_group[g] >= kFirstHiddenGroup) continue;
    const Facets facets = of_geom(m, g);
    const Matrix3 rotation = quaternion_from(m.geom_quat + 4 * g).toRotationMatrix();
    const Vector3 at(m.geom_pos[3 * g], m.geom_pos[3 * g + 1], m.geom_pos[3 * g + 2]);
    const auto first = static_cast<int>(all.points.size());
    for (const Vector3& p : facets.points) all.points.push_back(rotation * p + at);
    for (const Eigen::Vector3i& t : facets.triangles) all.triangles.push_back(t + Eigen::Vector3i::Constant(first));
  }
  return {rows_of<Positions>(all.points), rows_of<Triangles>(all.triangles)};
}

}  // namespace tacipc
