#include "stages/baseline/object_depth.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/error.h"

namespace tacipc {
namespace {

/// From camera coordinates (the camera at the origin) to pixels: column = 0.5 w + f_x x / z, row alike.
struct Projection {
  double scale_x, scale_y, middle_x, middle_y;

  explicit Projection(const Camera& camera)
      : scale_x(-camera.position_m.z() / camera.window_width_m * camera.width_px),
        scale_y(-camera.position_m.z() / camera.window_height_m * camera.height_px),
        middle_x(0.5 * camera.width_px),
        middle_y(0.5 * camera.height_px) {}
  double column(const Vector3& p) const { return middle_x + scale_x * p.x() / p.z(); }
  double row(const Vector3& p) const { return middle_y + scale_y * p.y() / p.z(); }
  /// Direction through the centre of a pixel, z = 1: a hit's ray parameter is its depth.
  Vector3 ray(int x, int y) const { return {(x + 0.5 - middle_x) / scale_x, (y + 0.5 - middle_y) / scale_y, 1.0}; }
};

/// Depth where the ray through the origin meets triangle (a, b, c); +∞ if it misses. The signed volumes of the ray with
/// the three edges have one sign inside; an edge's volume is the same number but for its sign in both its triangles, so
/// nothing falls between two.
double hit_depth(const Vector3& ray, const Vector3& a, const Vector3& b, const Vector3& c) {
  const double u = ray.dot(b.cross(c)), v = ray.dot(c.cross(a)), w = ray.dot(a.cross(b));
  const bool inside = (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
  const double sum = u + v + w;
  if (!inside || sum == 0.0) return std::numeric_limits<double>::infinity();
  return (u * a.z() + v * b.z() + w * c.z()) / sum;
}

}  // namespace

Raster object_depth(const TriangleMesh& object, const Matrix4& gel_from_object, const Camera& camera,
                    const std::string& name) {
  Positions seen(object.num_vertices(), 3);
  for (Eigen::Index i = 0; i < seen.rows(); ++i) {
    const Vector3 p = object.positions.row(i).transpose();
    seen.row(i) =
        (gel_from_object.topLeftCorner<3, 3>() * p + gel_from_object.topRightCorner<3, 1>() - camera.position_m)
            .transpose();
    if (!(seen(i, 2) > 0.0)) throw DataError("{}: the object reaches the camera", name);
  }
  const Projection projection(camera);
  Raster depth(camera.width_px, camera.height_px, std::numeric_limits<double>::infinity());
  for (Eigen::Index t = 0; t < object.num_triangles(); ++t) {
    const Vector3 a = seen.row(object.triangles(t, 0)), b = seen.row(object.triangles(t, 1)),
                  c = seen.row(object.triangles(t, 2));
    const auto [left, right] = std::minmax({projection.column(a), projection.column(b), projection.column(c)});
    const auto [top, bottom] = std::minmax({projection.row(a), projection.row(b), projection.row(c)});
    // One pixel more on each side than the exact box: rounding must not cut a triangle short.
    const auto first = [](double low) { return static_cast<int>(std::floor(std::max(low - 1.5, 0.0))); };
    const auto last = [](double high, int count) {
      return static_cast<int>(std::ceil(std::min(high + 0.5, count - 1.0)));
    };
    for (int y = first(top); y <= last(bottom, depth.height); ++y)
      for (int x = first(left); x <= last(right, depth.width); ++x)
        depth.at(x, y) = std::min(depth.at(x, y), hit_depth(projection.ray(x, y), a, b, c));
  }
  for (double& value : depth.values)
    if (std::isinf(value)) value = std::numeric_limits<double>::quiet_NaN();
  return depth;
}

Raster front_depth(const Sensor& sensor) {
  const Camera& camera = sensor.camera;
  const Projection projection(camera);
  Raster depth(camera.width_px, camera.height_px, -camera.position_m.z());
  if (!sensor.gel.dome_radius_m) return depth;
  // Sphere about (0, 0, −R) through the origin: the farther meeting with the ray is its side towards the object.
  const double radius = *sensor.gel.dome_radius_m;
  const Vector3 center = Vector3(0.0, 0.0, -radius) - camera.position_m;
  for (int y = 0; y < depth.height; ++y) {
    for (int x = 0; x < depth.width; ++x) {
      const Vector3 ray = projection.ray(x, y);
      const double a = ray.squaredNorm(), b = ray.dot(center), c = center.squaredNorm() - radius * radius;
      const double discriminant = b * b - a * c;
      depth.at(x, y) =
          discriminant < 0.0 ? std::numeric_limits<double>::quiet_NaN() : (b + std::sqrt(discriminant)) / a;
    }
  }
  return depth;
}

}  // namespace tacipc
