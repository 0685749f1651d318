#include "stages/image/calibrate/ball_discs.h"

#include <algorithm>
#include <cmath>

namespace tacipc {

std::vector<DiscPixel> disc_pixels(const BallDisc& disc, const ByteImage& photograph, const ByteImage& background,
                                   const std::array<double, 3>& drift) {
  const double reach = std::min(disc.contact_px, disc.radius_px);
  std::vector<DiscPixel> pixels;
  for (int y = 0; y < photograph.height; ++y) {
    for (int x = 0; x < photograph.width; ++x) {
      const double dx = x - disc.x_px, dy = y - disc.y_px, squared = dx * dx + dy * dy;
      if (!(squared < reach * reach)) continue;
      // h = √(R² − r²) + constant rises towards the centre.
      const double height = std::sqrt(disc.radius_px * disc.radius_px - squared);
      DiscPixel pixel{.x = x, .y = y, .slope_x = -dx / height, .slope_y = -dy / height};
      for (int c = 0; c < 3; ++c) {
        const auto k = static_cast<std::size_t>(c);
        const int code = photograph.at(x, y, c), before = background.at(x, y, c);
        pixel.target[k] = code - before - drift[k];
        pixel.used[k] = code > 0 && code < 255 && before > 0 && before < 255;
      }
      pixels.push_back(pixel);
    }
  }
  return pixels;
}

}  // namespace tacipc
