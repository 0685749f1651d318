#include "common/sensor/membrane_view.h"

#include <algorithm>
#include <cassert>

#include "common/base/error.h"

namespace tacipc {

void bound_depth(MembraneView& view) {
  view.lowest_z = 0.0;
  for (const Vector3& point : view.point) view.lowest_z = std::min(view.lowest_z, point.z());
}

MembraneView flat_view(const CameraModel& rays, const Camera& camera) {
  MembraneView view{.width = camera.width_px, .height = camera.height_px, .point = {}, .normal = {}, .rest = {}};
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const auto point = rays.on_plane(x + 0.5, y + 0.5);
      if (!point) throw DataError("pixel ({}, {}) of the camera does not look at the front face", x, y);
      view.rest.emplace_back(point->x(), point->y(), 0.0);
    }
  }
  view.point = view.rest;
  view.normal.assign(view.rest.size(), Vector3::UnitZ());
  return view;
}

Vector3 point_at_z(const CameraModel& rays, int x, int y, double z) {
  const CameraRay ray = rays.ray(x + 0.5, y + 0.5).value();
  return ray.origin + (z - ray.origin.z()) / ray.direction.z() * ray.direction;
}

MembraneView view_height_map(const FloatImage& indentation_m, const Sensor& sensor) {
  assert(indentation_m.width == sensor.camera.width_px && indentation_m.height == sensor.camera.height_px);
  const CameraModel rays(sensor.camera, sensor.stack);
  MembraneView view = flat_view(rays, sensor.camera);
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x)
      view.point[view.index(x, y)] = point_at_z(rays, x, y, -indentation_m.at(x, y, 0));
  bound_depth(view);
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
