#include "stages/rival/baseline/object_depth.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/base/error.h"
#include "common/sensor/pinhole.h"

namespace tacipc {

Raster object_depth(const TriangleMesh& object, const Matrix4& gel_from_object, const Camera& camera,
                    const std::string& name) {
  Positions seen(object.num_vertices(), 3);
  for (Eigen::Index i = 0; i < seen.rows(); ++i) {
    const Vector3 p = object.positions.row(i).transpose();
    const Vector3 in_gel = gel_from_object.topLeftCorner<3, 3>() * p + gel_from_object.topRightCorner<3, 1>();
    seen.row(i) = (in_gel - camera.position_m).transpose();
    if (!(seen(i, 2) > 0.0)) throw DataError("{}: the object reaches the camera", name);
  }
  Raster depth(camera.width_px, camera.height_px, std::numeric_limits<double>::infinity());
  for_each_hit(Pinhole(camera), seen, object.triangles, [&](int x, int y, Eigen::Index, const RayHit& hit) {
    depth.at(x, y) = std::min(depth.at(x, y), hit.depth);
  });
  for (double& value : depth.values)
    if (std::isinf(value)) value = std::numeric_limits<double>::quiet_NaN();
  return depth;
}

Raster front_depth(const Sensor& sensor) {
  const Camera& camera = sensor.camera;
  Raster depth(camera.width_px, camera.height_px, -camera.position_m.z());
  if (!sensor.gel.dome_radius_m) return depth;
  const Pinhole pinhole(camera);
  // Sphere about (0, 0, −R) through the origin: the farther meeting with the ray is its side towards the object.
  const double radius = *sensor.gel.dome_radius_m;
  const Vector3 center = Vector3(0.0, 0.0, -radius) - camera.position_m;
  for (int y = 0; y < depth.height; ++y) {
    for (int x = 0; x < depth.width; ++x) {
      const Vector3 ray = pinhole.ray(x, y);
      const double a = ray.squaredNorm(), b = ray.dot(center), c = center.squaredNorm() - radius * radius;
      const double discriminant = b * b - a * c;
      depth.at(x, y) =
          discriminant < 0.0 ? std::numeric_limits<double>::quiet_NaN() : (b + std::sqrt(discriminant)) / a;
    }
  }
  return depth;
}

}  // namespace tacipc
