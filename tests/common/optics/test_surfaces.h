// Membranes and sensors with known answers.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/image/image.h"
#include "common/optics/membrane.h"
#include "common/optics/trace.h"
#include "common/sensor/sensor.h"

namespace tacipc {

constexpr double kMm = 1e-3;

/// Height field over |x| ≤ half_width, |y| ≤ half_height with square cells of about `spacing`, each cut into four
/// triangles about its centre, so that the mesh looks the same from all four sides. The rest surface is z = 0.
Membrane height_field(double half_width, double half_height, double spacing,
                      const std::function<double(double, double)>& z);

/// A plateau 1 mm towards the light on x > 0 with a vertical wall, 8 mm square; vertices are not shared, so the edges
/// are sharp.
Membrane step_of_1mm();

/// A sensor with a camera 12 mm behind the front face, a window of 4 by 3 mm, no lights, response linear 0.5.
Sensor plain_sensor(int width_px, int height_px);

/// White point light of intensity 1, isotropic.
Led point_light(const Vector3& position_m);

/// As `trace`, of a membrane alone.
inline TraceResult trace(const Membrane& membrane, const Sensor& sensor, const TraceSettings& settings,
                         const SurfaceFields& fields = {}) {
  const RayScene scene(membrane.positions, membrane.triangles);
  return trace(scene, membrane, sensor, settings, fields);
}

/// Largest |a − b| of two images of one shape.
double largest_difference(const FloatImage& a, const FloatImage& b);

/// 1 mm deep press of a ball of 3 mm radius with a smooth rim, as a height field.
double ball_press(double x, double y);

}  // namespace tacipc
