// Describes the camera for users of its images, in millimetres and pixels.
#pragma once

#include "common/base/value.h"
#include "common/sensor/sensor.h"

namespace tacipc {

/// Returns the lines `camera_model`, `width_px`, `height_px`, `window_mm` (the field of view: what the middle row and
/// column show of the plane z = 0), `mm_per_px` (along x and y in the middle of that plane), `T_S_camera` (4 × 4,
/// camera to S, mm; camera axes x right, y down, z along the view), and
/// - pinhole, fisheye: `K` (3 × 3, px; pixel (0, 0) spans 0 … 1), `distortion_radial` and `distortion_tangential` in
///   Brown's order (fisheye: of θ);
/// - rectified: `plane_from_pixel` (3 × 3): [x, y, 1] in mm on the plane z = 0 from [column, row, 1].
/// If the model lacks one of these, `K_absent` or `plane_from_pixel_absent` gives the reason.
Value::Map describe_camera(const Sensor& sensor);

}  // namespace tacipc
