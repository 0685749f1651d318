// A map of heights seen from straight above, as the sensor's camera sees it.
#pragma once

#include "common/image/image.h"
#include "common/sensor/sensor.h"
#include "stages/rival/mpm/height_map.h"

namespace tacipc {

/// Indentation (m, > 0 into the gel) of what each pixel's ray, bent at the sensor's layers, meets first of the surface
/// that `from_above` (indentation_map's) describes, linear between its pixels and constant outside: the map that
/// baseline makes and render, shade and calibrate take. \throw DataError if a pixel does not look at the front face
FloatImage seen_along_rays(const FloatImage& from_above, const Sensor& sensor, PixelPlaces places);

}  // namespace tacipc
