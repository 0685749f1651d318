// Light that reaches the membrane from the membrane itself: from wall to wall, and back from the window by total
// reflection. One bounce, gathered at the vertices by quasi-Monte-Carlo.
#pragma once

#include <cstdint>

#include "common/optics/membrane.h"
#include "common/optics/ray_scene.h"
#include "common/sensor/sensor.h"

namespace tacipc {

/// #V × groups, radiance of a Lambert coating of albedo 1 under direct light, 1/m². Shadows as in `trace`.
using VertexLight = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
VertexLight direct_vertex_light(const RayScene& scene, const Membrane& membrane, const Sensor& sensor, int led_samples,
                                bool refract);

/// Radiance, at albedo 1, that a vertex returns of what arrives from other points of the membrane, whose radiance is
/// `light`: the mean over `rays` directions distributed as cos θ of what each of them meets,
///   the membrane itself, or, mirrored where the layers end (with Fresnel's reflectance, 1 beyond the critical angle,
///   inside the gel's outline), the membrane there. The rest is lost.
/// Directions are Sobol's first two dimensions, shifted by a number that depends on the vertex alone, so the result is
/// the same at any number of threads and on any run. [Cranley and Patterson 1976; Sobol 1967]
VertexLight gather_indirect(const RayScene& scene, const Membrane& membrane, const VertexLight& light,
                            const Sensor& sensor, int rays, bool refract);

/// Fresnel reflectance for unpolarised light that comes from index `from` at an angle with this sine and meets index
/// `to`; 1 beyond the critical angle.
double fresnel_reflectance(double sine, double from, double to);

}  // namespace tacipc
