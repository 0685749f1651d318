// Indirect light: light that reaches the membrane from the membrane itself, directly or by total reflection at the back
// of the layers. One bounce, gathered at the vertices by quasi-Monte Carlo.
#pragma once

#include <cstdint>

#include "common/optics/membrane.h"
#include "common/optics/ray_scene.h"
#include "common/sensor/sensor.h"

namespace tacipc {

/// Direct light at the vertices, #V × groups: radiance of a Lambertian coating of albedo 1, 1/m². Shadows as in
/// trace().
using VertexLight = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
VertexLight direct_vertex_light(const RayScene& scene, const Membrane& membrane, const Sensor& sensor, int led_samples,
                                bool refract);

/// Returns the radiance, at albedo 1, that each vertex reflects of the light from other points of the membrane, whose
/// radiance is `light`: the mean over `rays` directions distributed as cos θ. A direction meets either the membrane
/// itself or the back of the layers; there it is mirrored (with Fresnel's reflectance, 1 beyond the critical angle,
/// inside the gel's outline) and meets the membrane. Other directions are lost.
/// Directions are Sobol's first two dimensions, shifted by a number that depends on the vertex alone, so that the
/// result does not depend on threads or runs. [Cranley and Patterson 1976; Sobol 1967]
VertexLight gather_indirect(const RayScene& scene, const Membrane& membrane, const VertexLight& light,
                            const Sensor& sensor, int rays, bool refract);

/// Returns Fresnel's reflectance for unpolarised light that comes from index `from` at an angle with this sine and
/// meets index `to`; 1 beyond the critical angle.
double fresnel_reflectance(double sine, double from, double to);

}  // namespace tacipc
