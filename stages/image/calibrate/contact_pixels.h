// Pixels of a photograph inside the contact of an object, where the membrane has the object's own slope.
#pragma once

#include <array>
#include <vector>

#include "common/image/image.h"

namespace tacipc {

/// One pixel in a contact.
struct ContactPixel {
  int x = 0, y = 0;
  double slope_x = 0.0, slope_y = 0.0;  // slopes of the surface, positive into the gel
  std::array<double, 3> target{};       // photograph − background − drift, grey levels
  std::array<bool, 3> used{};           // false if the photograph or the background is clipped

  bool all_used() const { return used[0] && used[1] && used[2]; }
};

/// A contact as a circle, and the ball, in pixels.
struct BallDisc {
  double x_px = 0.0, y_px = 0.0;  // pixel at whose middle the centre lies
  double contact_px = 0.0;
  double radius_px = 0.0;  // radius of the ball
};

/// Pixels nearer to the centre than both the contact's radius and the ball's, in raster order.
std::vector<ContactPixel> disc_pixels(const BallDisc& disc, const ByteImage& photograph, const ByteImage& background,
                                      const std::array<double, 3>& drift);

/// Pixels where a rigid object and its four neighbours are in the gel, in raster order; the membrane is assumed to
/// follow the object there. Slopes are central differences.
/// \param height_m height of the object, > 0 into the gel, from straight above over pixels of `pixel_m`
/// \pre equal sizes
std::vector<ContactPixel> object_pixels(const FloatImage& height_m, double pixel_m, const ByteImage& photograph,
                                        const ByteImage& background, const std::array<double, 3>& drift);

}  // namespace tacipc
