// A straight pinhole camera.
#pragma once

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

}  // namespace tacipc
