// Made-up tactile images with colours that differ from side to side, as lamps make them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "common/base/rng.h"
#include "common/image/image.h"

namespace tacipc {

/// A sensor: where its red, green and blue lamps are (degrees, from x towards y), and how bright.
struct MadeUpLamps {
  std::array<double, 3> degrees{10.0, 130.0, 235.0};
  std::array<double, 3> codes{105.0, 120.0, 95.0};
};

/// Dent `index` at a place, with a radius and a depth of its own; without one, the gel at rest. Noise is of one code.
inline ByteImage shaded_image(const MadeUpLamps& lamps, std::size_t index, bool touched, int width = 96,
                              int height = 72) {
  const auto draw = [&](std::uint64_t counter) { return random_uniform(11, index, counter); };
  const double x0 = width * (0.3 + 0.4 * draw(0)), y0 = height * (0.3 + 0.4 * draw(1)),
               radius = height * (0.1 + 0.12 * draw(2)), deep = touched ? 0.4 + 0.6 * draw(3) : 0.0;
  const double corners = 3.0 + std::floor(4.0 * draw(4)), turn = 6.28 * draw(5);
  ByteImage image(width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double dx = x - x0, dy = y - y0, angle = std::atan2(dy, dx);
      const double far = std::hypot(dx, dy) / (radius * (1.0 + 0.15 * std::cos(corners * angle + turn)));
      const double slope = far < 1.0 ? 4.0 * deep * far * (1.0 - far * far) : 0.0;  // of 1 - 2 far^2 + far^4
      for (int c = 0; c < 3; ++c) {
        const double lamp = lamps.degrees[c] * 3.14159265358979 / 180.0;
        const double towards = std::cos(lamp) * (2.0 * x / width - 1.0) + std::sin(lamp) * (2.0 * y / height - 1.0);
        const double lit = lamps.codes[c] * (1.0 + 0.25 * towards + 0.06 * towards * towards);
        const double shade = 0.6 * slope * std::cos(angle - lamp);
        const double noise =
            random_normal(12, 2 * index + touched, (static_cast<std::uint64_t>(y) * width + x) * 3 + c);
        image.at(x, y, c) = static_cast<std::uint8_t>(std::clamp(lit * (1.0 + shade) + noise + 0.5, 0.0, 255.0));
      }
    }
  return image;
}

}  // namespace tacipc
