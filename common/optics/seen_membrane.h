// Computes the view of the membrane, pixel by pixel, that a light field (common/sensor/light_field.h) shades.
#pragma once

#include "common/optics/trace.h"
#include "common/sensor/membrane_view.h"

namespace tacipc {

/// Traces one ray through each pixel's centre to the front face, given as `triangles` (outward) over vertices at
/// `positions` (m, frame S). Pixels without a hit count as flat front.
/// \throw DataError if a ray inside the front's outline slips through it even after a retry, or a pixel's ray does not
/// meet the plane z = 0
MembraneView view_membrane(const Positions& positions, const Triangles& triangles, const Sensor& sensor);

/// Computes the view from a traced picture: mean depth and normal of each pixel's rays.
/// \pre traced with this sensor
MembraneView view_of(const TraceResult& traced, const Sensor& sensor, bool refract = true);

}  // namespace tacipc
