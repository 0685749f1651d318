// The membrane as the sensor's camera sees it, pixel by pixel: what a light field (common/sensor/light_field.h) shades.
#pragma once

#include "common/optics/trace.h"
#include "common/sensor/membrane_view.h"

namespace tacipc {

/// The front face as `triangles` (outward) over vertices at `positions` (m, frame S), one ray through each pixel's
/// centre. A flat front is taken for granted where nothing is seen.
/// \throw DataError if a ray inside the front's outline slips through it even after a retry, or a pixel looks away from
/// the plane z = 0.
MembraneView view_membrane(const Positions& positions, const Triangles& triangles, const Sensor& sensor);

/// The same from what was traced already: mean depth and normal of each pixel's rays. \pre traced with this sensor
MembraneView view_of(const TraceResult& traced, const Sensor& sensor, bool refract = true);

}  // namespace tacipc
