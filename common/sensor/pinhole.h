// A straight pinhole camera, and where a ray meets a triangle.
#pragma once

#include <array>
#include <optional>

#include "common/base/types.h"
#include "common/sensor/sensor.h"

namespace tacipc {

/// Camera coordinates have the camera at the origin and the axes of S: (x, y, z) appears at column w/2 + f_x x / z and
/// row h/2 + f_y y / z, in pixels from the outer corner of pixel (0, 0).
class Pinhole {
 public:
  explicit Pinhole(const Camera& camera)
      : width(camera.width_px),
        height(camera.height_px),
        position(camera.position_m),
        scale_x_(-camera.position_m.z() / camera.window_width_m * camera.width_px),
        scale_y_(-camera.position_m.z() / camera.window_height_m * camera.height_px) {}

  double column(const Vector3& p) const { return 0.5 * width + scale_x_ * p.x() / p.z(); }
  double row(const Vector3& p) const { return 0.5 * height + scale_y_ * p.y() / p.z(); }
  /// Direction through the centre of a pixel, z = 1: a hit's ray parameter is its depth.
  Vector3 ray(double x, double y) const {
    return {(x + 0.5 - 0.5 * width) / scale_x_, (y + 0.5 - 0.5 * height) / scale_y_, 1.0};
  }
  /// The point of the plane z = 0 of S behind a pixel's centre; pixels may be fractions.
  Vector3 plane_point(double x, double y) const { return position - position.z() * ray(x, y); }

  int width;
  int height;
  Vector3 position;

 private:
  double scale_x_, scale_y_;
};

struct RayHit {
  double depth = 0.0;                   // along the camera's axis
  std::array<double, 3> barycentric{};  // of the corners, sum 1
};

/// Where the ray from the origin meets triangle (a, b, c). The signed volumes of the ray with the three edges have one
/// sign inside; an edge's volume is the same number but for its sign in both its triangles, so nothing falls between
/// two, and a ray through an edge meets both.
inline std::optional<RayHit> ray_hit(const Vector3& ray, const Vector3& a, const Vector3& b, const Vector3& c) {
  const double u = ray.dot(b.cross(c)), v = ray.dot(c.cross(a)), w = ray.dot(a.cross(b));
  const bool inside = (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
  const double sum = u + v + w;
  if (!inside || sum == 0.0) return std::nullopt;
  return RayHit{(u * a.z() + v * b.z() + w * c.z()) / sum, {u / sum, v / sum, w / sum}};
}

}  // namespace tacipc
