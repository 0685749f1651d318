// Our picture with shadow rays that start where other renderers start them.
#pragma once

#include "common/image/image.h"
#include "common/optics/membrane.h"
#include "common/sensor/sensor.h"

namespace tacipc {

/// Straight light of point lights on white Lambert paint, a ray per pixel, as `trace` makes it but for one thing:
/// shadow rays start on the flat triangle (2e-9 m above it), not at the smooth surface that the vertex normals
/// describe. So the triangles of a curved surface hide one another where light grazes it. \pre a sensor from
/// comparable_sensor
FloatImage flat_start_image(const Membrane& membrane, const Sensor& sensor);

}  // namespace tacipc
