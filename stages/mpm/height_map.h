// The front as the camera's image of heights.
#pragma once

#include "common/image.h"
#include "common/sensor.h"
#include "stages/mpm/gel_lattice.h"

namespace tacipc {

/// Where the pixels of an image look on the plane z = 0, straight down whatever the camera's model: the first and last
/// of a row and a column at the window's edges (as published), or half a pixel inside.
enum class PixelPlaces { ends, centres };

/// Indentation (m, > 0 into the gel) of the front's particles at `front_m` (undeformed at z = 0), interpolated between
/// them as deformed; 0 beside the gel.
FloatImage indentation_map(const GelLattice& lattice, const Positions& front_m, const Camera& camera,
                           PixelPlaces places);

}  // namespace tacipc
