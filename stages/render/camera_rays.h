// From a point of the image to a ray inside the gel.
#pragma once

#include "common/sensor.h"
#include "stages/render/ray_scene.h"

namespace tacipc {

/// Straight pinhole rays. The camera at `position_m` looks along +z; its window, centred before it on the plane z = 0,
/// is cut into width_px × height_px pixels, column 0 at the smallest x, row 0 at the smallest y.
class CameraRays {
 public:
  explicit CameraRays(const Camera& camera) : camera_(camera) {}

  /// Ray through the image point (column, row), in pixels from the outer corner of pixel (0, 0): its centre is
  /// (0.5, 0.5).
  Ray ray(double column, double row) const {
    const Vector3 target(camera_.position_m.x() + (column / camera_.width_px - 0.5) * camera_.window_width_m,
                         camera_.position_m.y() + (row / camera_.height_px - 0.5) * camera_.window_height_m, 0.0);
    return {.origin = camera_.position_m, .direction = (target - camera_.position_m).normalized()};
  }

 private:
  Camera camera_;
};

}  // namespace tacipc
