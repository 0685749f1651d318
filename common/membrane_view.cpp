#include "common/membrane_view.h"

#include <cassert>
#include <cmath>
#include <limits>

#include "common/pinhole.h"

namespace tacipc {
namespace {

MembraneView flat_view(const Pinhole& pinhole) {
  MembraneView view{.width = pinhole.width, .height = pinhole.height, .point = {}, .normal = {}, .rest = {}};
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x) view.rest.push_back(pinhole.plane_point(x, y));
  view.point = view.rest;
  view.normal.assign(view.rest.size(), Vector3::UnitZ());
  return view;
}

Positions area_weighted_normals(const Positions& positions, const Triangles& triangles) {
  Positions normals = Positions::Zero(positions.rows(), 3);
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const Vector3 a = positions.row(triangles(t, 0)), b = positions.row(triangles(t, 1)),
                  c = positions.row(triangles(t, 2));
    const Vector3 area = (b - a).cross(c - a);
    for (int i = 0; i < 3; ++i) normals.row(triangles(t, i)) += area.transpose();
  }
  return normals;
}

}  // namespace

MembraneView view_membrane(const Positions& positions, const Triangles& triangles, const Camera& camera) {
  const Pinhole pinhole(camera);
  MembraneView view = flat_view(pinhole);
  const Positions normals = area_weighted_normals(positions, triangles);
  Positions seen = positions;
  seen.rowwise() -= camera.position_m.transpose();
  std::vector<double> nearest(view.point.size(), std::numeric_limits<double>::infinity());
  for_each_hit(pinhole, seen, triangles, [&](int x, int y, Eigen::Index t, const RayHit& hit) {
    const std::size_t i = view.index(x, y);
    if (!(hit.depth < nearest[i])) return;
    Vector3 normal = Vector3::Zero();
    for (int k = 0; k < 3; ++k)
      normal += hit.barycentric[static_cast<std::size_t>(k)] * normals.row(triangles(t, k)).normalized().transpose();
    if (normal.norm() < 1e-9) return;
    nearest[i] = hit.depth;
    view.point[i] = camera.position_m + hit.depth * pinhole.ray(x, y);
    view.normal[i] = normal.normalized();
  });
  return view;
}

MembraneView view_height_map(const FloatImage& indentation_m, const Camera& camera) {
  assert(indentation_m.width == camera.width_px && indentation_m.height == camera.height_px);
  const Pinhole pinhole(camera);
  MembraneView view = flat_view(pinhole);
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x)
      view.point[view.index(x, y)] =
          camera.position_m + (-camera.position_m.z() - indentation_m.at(x, y, 0)) * pinhole.ray(x, y);
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const auto at = [&](int u, int v) {
        return view.point[view.index(std::clamp(u, 0, view.width - 1), std::clamp(v, 0, view.height - 1))];
      };
      const Vector3 along_x = at(x + 1, y) - at(x - 1, y), along_y = at(x, y + 1) - at(x, y - 1);
      const Vector3 normal = along_x.cross(along_y);
      if (normal.z() > 0.0) view.normal[view.index(x, y)] = normal.normalized();
    }
  }
  return view;
}

Positions moved(const Positions& positions, double x_m, double y_m, double yaw_rad) {
  Matrix3 turn = Eigen::AngleAxisd(yaw_rad, Vector3::UnitZ()).toRotationMatrix();
  Positions out = positions * turn.transpose();
  out.rowwise() += Eigen::RowVector3d(x_m, y_m, 0.0);
  return out;
}

}  // namespace tacipc
