#include "stages/image/calibrate/contact_pixels.h"

#include <algorithm>
#include <cmath>

namespace tacipc {
namespace {

ContactPixel contact_pixel(int x, int y, const ByteImage& photograph, const ByteImage& background,
                           const std::array<double, 3>& drift) {
  ContactPixel pixel{.x = x, .y = y};
  for (int c = 0; c < 3; ++c) {
    const int code = photograph.at(x, y, c), before = background.at(x, y, c);
    pixel.target[c] = code - before - drift[c];
    pixel.used[c] = code > 0 && code < 255 && before > 0 && before < 255;
  }
  return pixel;
}

}  // namespace

std::vector<ContactPixel> disc_pixels(const BallDisc& disc, const ByteImage& photograph, const ByteImage& background,
                                      const std::array<double, 3>& drift) {
  const double reach = std::min(disc.contact_px, disc.radius_px);
  std::vector<ContactPixel> pixels;
  for (int y = 0; y < photograph.height; ++y) {
    for (int x = 0; x < photograph.width; ++x) {
      const double dx = x - disc.x_px, dy = y - disc.y_px, squared = dx * dx + dy * dy;
      if (!(squared < reach * reach)) continue;
      // The surface h = √(R² − r²) + constant rises towards the centre.
      const double height = std::sqrt(disc.radius_px * disc.radius_px - squared);
      ContactPixel& pixel = pixels.emplace_back(contact_pixel(x, y, photograph, background, drift));
      pixel.slope_x = (0.0 - dx) / height;  // 0 instead of −0 in the centre's row and column, where −dx would turn the
      pixel.slope_y = (0.0 - dy) / height;  // direction from π to −π; as published, whose offsets are integers
    }
  }
  return pixels;
}

std::vector<ContactPixel> object_pixels(const FloatImage& height_m, double pixel_m, const ByteImage& photograph,
                                        const ByteImage& background, const std::array<double, 3>& drift) {
  std::vector<ContactPixel> pixels;
  for (int y = 1; y + 1 < height_m.height; ++y) {
    for (int x = 1; x + 1 < height_m.width; ++x) {
      const std::array<double, 5> h{height_m.at(x, y, 0), height_m.at(x - 1, y, 0), height_m.at(x + 1, y, 0),
                                    height_m.at(x, y - 1, 0), height_m.at(x, y + 1, 0)};
      if (!(*std::ranges::min_element(h) > 0.0)) continue;
      ContactPixel& pixel = pixels.emplace_back(contact_pixel(x, y, photograph, background, drift));
      pixel.slope_x = (h[2] - h[1]) / (2.0 * pixel_m);
      pixel.slope_y = (h[4] - h[3]) / (2.0 * pixel_m);
    }
  }
  return pixels;
}

}  // namespace tacipc
