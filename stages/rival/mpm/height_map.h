// The front as the camera's image of heights.
#pragma once

#include "common/image/image.h"
#include "common/sensor/sensor.h"
#include "stages/rival/mpm/gel_lattice.h"

namespace tacipc {

/// Where the pixels of an image look on the plane z = 0, straight down whatever the camera's model: the first and last
/// of a row and a column at the window's edges (as published), or half a pixel inside.
enum class PixelPlaces { ends, centres };

/// Pixels of one row or column: the place of pixel i is first + i · step.
struct PixelLine {
  double first, step;
  int count;

  PixelLine(double center_m, double window_m, int pixels, PixelPlaces places);
  double place(int i) const { return first + i * step; }
  /// The pixel at a place, between pixels a fraction.
  double pixel(double at) const { return step > 0.0 ? (at - first) / step : 0.0; }
  /// The first and the last pixel that can lie in an interval.
  int from(double low) const;
  int to(double high) const;
};

/// Indentation (m, > 0 into the gel) of the front's particles at `front_m` (undeformed at z = 0), interpolated between
/// them as deformed; 0 beside the gel.
FloatImage indentation_map(const GelLattice& lattice, const Positions& front_m, const Camera& camera,
                           PixelPlaces places);

}  // namespace tacipc
