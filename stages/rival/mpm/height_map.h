// Height maps of the front: from straight above, and along the rays of the sensor's camera.
#pragma once

#include <algorithm>
#include <cmath>

#include "common/image/image.h"
#include "common/sensor/sensor.h"
#include "stages/rival/mpm/gel_lattice.h"

namespace tacipc {

/// Pixel positions of an image on the plane z = 0, seen from straight above for any camera model. The first and last
/// pixel of a row and a column lie on the edges of the field of view (as published), or half a pixel inside.
enum class PixelPlaces { ends, centres };

/// Pixels of one row or column: pixel i is at first + i · step, m.
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
  /// Pixel index at a position, with a fraction.
  double pixel(double at) const { return step > 0.0 ? (at - first) / step : 0.0; }
  /// First and last pixel that can lie in an interval.
  int from(double low) const { return step > 0.0 ? std::max(0, static_cast<int>(std::floor(pixel(low)))) : 0; }
  int to(double high) const {
    return step > 0.0 ? static_cast<int>(std::min(count - 1.0, std::ceil(pixel(high)))) : count - 1;
  }
};

/// Indentation map (m, > 0 into the gel) from the front's particles at `front_m` (undeformed at z = 0), interpolated
/// between their deformed positions; 0 outside the gel.
FloatImage indentation_map(const GelLattice& lattice, const Positions& front_m, const Camera& camera,
                           PixelPlaces places);

/// Indentation map (m, > 0 into the gel) along each pixel's ray, refracted at the sensor's layers. The surface is the
/// one that `from_above` (of indentation_map) describes, linear between its pixels and constant outside; the first
/// intersection counts. Its format is that of baseline's maps, which render, shade and calibrate read.
/// \throw DataError if a pixel does not look at the front face
FloatImage seen_along_rays(const FloatImage& from_above, const Sensor& sensor, PixelPlaces places);

}  // namespace tacipc
