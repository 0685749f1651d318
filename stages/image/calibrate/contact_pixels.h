// What a photograph shows of an object itself: the pixels in its contact, where the membrane has the object's own
// slope.
#pragma once

#include <array>
#include <vector>

#include "common/image/image.h"

namespace tacipc {

struct ContactPixel {
  int x = 0, y = 0;
  double slope_x = 0.0, slope_y = 0.0;  // by which the surface rises into the gel
  std::array<double, 3> target{};       // codes, photograph less background less drift
  std::array<bool, 3> used{};           // neither is clipped

  bool all_used() const { return used[0] && used[1] && used[2]; }
};

/// A contact as a circle, and the ball in pixels.
struct BallDisc {
  double x_px = 0.0, y_px = 0.0;  // pixel whose middle it is
  double contact_px = 0.0;
  double radius_px = 0.0;  // of the ball
};

/// Pixels nearer to the centre than the contact's radius and the ball's, in raster order.
std::vector<ContactPixel> disc_pixels(const BallDisc& disc, const ByteImage& photograph, const ByteImage& background,
                                      const std::array<double, 3>& drift);

/// Pixels where a rigid object is in the gel with their four neighbours, in raster order; the membrane is taken to
/// follow it there. `height_m`: of the object, > 0 into the gel, straight from above over pixels of `pixel_m`; slopes
/// are central differences. \pre equal sizes
std::vector<ContactPixel> object_pixels(const FloatImage& height_m, double pixel_m, const ByteImage& photograph,
                                        const ByteImage& background, const std::array<double, 3>& drift);

}  // namespace tacipc
