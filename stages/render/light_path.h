// From a point of the membrane to a light: where the light comes from and how much of it.
#pragma once

#include <cstddef>
#include <vector>

#include "common/sensor.h"
#include "common/types.h"

namespace tacipc {

/// One quadrature point of a light.
struct LightSample {
  Vector3 position_m = Vector3::Zero();
  Vector3 normal = Vector3::UnitZ();  // unit, the direction of its maximum
  bool lambertian = true;
  double weight = 1.0;  // share of the light's intensity
  int led = 0;          // whose it is
};

/// Midpoints of an edge_samples × edge_samples grid on each square emitter, a single point for lights without size.
/// The squares are turned so that an edge faces the sensor's axis, as packages on a ring board sit.
std::vector<LightSample> light_samples(const std::vector<Led>& leds, int edge_samples);

/// Light that arrives at a point on the way from one light sample.
struct Incidence {
  Vector3 direction;  // unit, from the point towards the light, in the gel
  Vector3 path_end;   // the path inside the gel is free if nothing blocks the segment from the point to here
  double irradiance;  // on a surface that faces `direction`, per unit of intensity along the light's normal, 1/m²
};

/// Straight path: E = weight · (cos θ for a Lambertian light, else 1) / d²; nothing behind a Lambertian light.
Incidence light_path(const Vector3& point, const LightSample& sample);

}  // namespace tacipc
