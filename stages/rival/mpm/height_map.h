// The front as maps of heights: from straight above, and as the sensor's camera sees it.
#pragma once

#include "common/image/image.h"
#include "common/sensor/sensor.h"
#include "stages/rival/mpm/gel_lattice.h"

namespace tacipc {

/// Where the pixels of an image look on the plane z = 0, straight down whatever the camera's model: the first and last
/// of a row and a column at the window's edges (as published), or half a pixel inside.
enum class PixelPlaces { ends, centres };

/// Indentation (m, > 0 into the gel) of the front's particles at `front_m` (undeformed at z = 0), interpolated between
/// them as deformed; 0 beside the gel.
FloatImage indentation_map(const GelLattice& lattice, const Positions& front_m, const Camera& camera,
                           PixelPlaces places);

/// Indentation (m, > 0 into the gel) of what each pixel's ray, bent at the sensor's layers, meets first of the surface
/// that `from_above` (indentation_map's) describes, linear between its pixels and constant outside: the map that
/// baseline makes and render, shade and calibrate take. \throw DataError if a pixel does not look at the front face
FloatImage seen_along_rays(const FloatImage& from_above, const Sensor& sensor, PixelPlaces places);

}  // namespace tacipc
