// What the sensor's camera sees of the deformed front face, pixel by pixel.
#pragma once

#include <vector>

#include "common/base/types.h"
#include "common/image/image.h"
#include "common/sensor/camera_model.h"
#include "common/sensor/sensor.h"

namespace tacipc {

/// Row-major, one entry per pixel. Pixels that see no membrane count as flat front.
struct MembraneView {
  int width = 0;
  int height = 0;
  std::vector<Vector3> point;   // frame S, m
  std::vector<Vector3> normal;  // unit, outward: (0, 0, 1) where it is flat
  std::vector<Vector3> rest;    // the point of the plane z = 0 on the same ray
  double lowest_z = -3e-3;      // m; no point lies deeper. A bound that every press keeps until the view is complete

  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * width + x; }
};

/// Sets lowest_z to the deepest point.
void bound_depth(MembraneView& view);

/// All of it flat. \throw DataError if a pixel looks away from the plane z = 0
MembraneView flat_view(const CameraModel& rays, const Camera& camera);

/// Where the ray through a pixel's centre has this height, m. \pre flat_view did not throw
Vector3 point_at_z(const CameraModel& rays, int x, int y, double z);

/// A membrane given by its indentation (m, > 0 into the gel) at each pixel: the point on the pixel's ray at that depth;
/// slopes by central differences over the neighbouring points (one-sided at the image's border).
/// \pre the image has the camera's size
MembraneView view_height_map(const FloatImage& indentation_m, const Sensor& sensor);

/// Turned by `yaw_rad` about z (from x towards y), then moved by (x, y): what a press at another place would be, as far
/// as the gel's rim does not matter.
Positions moved(const Positions& positions, double x_m, double y_m, double yaw_rad);

}  // namespace tacipc
