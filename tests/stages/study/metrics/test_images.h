// Images by formula in whole numbers, the same as in make_golden.py.
#pragma once

#include <algorithm>
#include <string_view>

#include "common/image/image.h"

namespace tacipc {

inline ByteImage pattern_image(int width, int height) {
  ByteImage image(width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c)
        image.at(x, y, c) =
            static_cast<std::uint8_t>((3 * x + 5 * y + 40 * c + x * y / 7 + (x * x + 3 * y) % 11) % 256);
  return image;
}

inline ByteImage changed(const ByteImage& image, std::string_view kind) {
  ByteImage out = image;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        int value = image.at(x, y, c);
        if (kind == "noise") value += (7 * x + 11 * y + 5 * c + x * y) % 23 - 11;
        if (kind == "fade") value = (value * 3 + 128) / 4;
        if (kind == "shift") value = image.at((x + image.width - 2) % image.width, y, c);
        if (kind == "negative") value = 255 - value;
        out.at(x, y, c) = static_cast<std::uint8_t>(std::clamp(value, 0, 255));
      }
    }
  }
  return out;
}

}  // namespace tacipc
