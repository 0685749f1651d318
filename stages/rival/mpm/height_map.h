// The front as maps of heights: from straight above, and as the sensor's camera sees it.
#pragma once

#include <algorithm>
#include <cmath>

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

  PixelLine(double center_m, double window_m, int pixels, PixelPlaces places)
      : first(center_m - 0.5 * window_m), step(window_m / pixels), count(pixels) {
    if (places == PixelPlaces::ends)
      step = pixels > 1 ? window_m / (pixels - 1) : 0.0;
    else
      first += 0.5 * step;
  }
  double place(int i) const { return first + i * step; }
  /// The pixel at a place, between pixels a fraction.
  double pixel(double at) const { return step > 0.0 ? (at - first) / step : 0.0; }
  /// The first and the last pixel that can lie in an interval.
  int from(double low) const { return step > 0.0 ? std::max(0, static_cast<int>(std::floor(pixel(low)))) : 0; }
  int to(double high) const {
    return step > 0.0 ? static_cast<int>(std::min(count - 1.0, std::ceil(pixel(high)))) : count - 1;
  }
};

/// Indentation (m, > 0 into the gel) of the front's particles at `front_m` (undeformed at z = 0), interpolated between
/// them as deformed; 0 beside the gel.
FloatImage indentation_map(const GelLattice& lattice, const Positions& front_m, const Camera& camera,
                           PixelPlaces places);

/// Indentation (m, > 0 into the gel) of what each pixel's ray, bent at the sensor's layers, meets first of the surface
/// that `from_above` (indentation_map's) describes, linear between its pixels and constant outside: the map that
/// baseline makes and render, shade and calibrate take. \throw DataError if a pixel does not look at the front face
FloatImage seen_along_rays(const FloatImage& from_above, const Sensor& sensor, PixelPlaces places);

}  // namespace tacipc
