// The deformed front face as the sensor's camera shows it, pixel by pixel.
#pragma once

#include <vector>

#include "common/base/types.h"
#include "common/image/image.h"
#include "common/sensor/camera_model.h"
#include "common/sensor/sensor.h"

namespace tacipc {

/// View of the membrane: row-major, one entry per pixel. Pixels that show no membrane count as flat front.
struct MembraneView {
  int width = 0;
  int height = 0;
  std::vector<Vector3> point;   // frame S, m
  std::vector<Vector3> normal;  // unit, outward: (0, 0, 1) on the flat front
  std::vector<Vector3> rest;    // the point of the plane z = 0 on the same ray
  double lowest_z = -3e-3;      // lower bound of all z, m; the initial value holds for every press

  /// Returns the index of a pixel.
  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * width + x; }
};

/// Sets lowest_z to the z of the deepest point.
void bound_depth(MembraneView& view);

/// Returns the view of the flat front.
/// \throw DataError if a pixel's ray does not meet the plane z = 0
MembraneView flat_view(const CameraModel& rays, const Camera& camera);

/// Returns the point of height z on the ray through a pixel's centre, m.
/// \pre flat_view() did not throw
Vector3 point_at_z(const CameraModel& rays, int x, int y, double z);

/// Returns the view of a membrane given by its indentation at each pixel (m, > 0 into the gel): the point at that depth
/// on the pixel's ray. Slopes are central differences over the neighbouring points (one-sided at the image's border).
/// \pre the image has the camera's size
MembraneView view_height_map(const FloatImage& indentation_m, const Sensor& sensor);

/// Rotates positions by `yaw_rad` about z (from x towards y), then shifts them by (x, y). This is a press at another
/// position, as long as the gel's rim does not matter.
Positions moved(const Positions& positions, double x_m, double y_m, double yaw_rad);

}  // namespace tacipc
