#include "stages/study/metrics/image_error.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>

namespace tacipc {

ImageError image_error(const ByteImage& a, const ByteImage& b) {
  assert(a.pixels.size() == b.pixels.size() && !a.pixels.empty());
  // Integers: the sum is exact in any order.
  std::int64_t absolute = 0, squared = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const std::int64_t difference = int{a.pixels[i]} - int{b.pixels[i]};
    absolute += std::abs(difference);
    squared += difference * difference;
  }
  const auto count = static_cast<double>(a.pixels.size());
  return {.mae = static_cast<double>(absolute) / (255.0 * count),
          .mse = static_cast<double>(squared) / (255.0 * 255.0 * count)};
}

ByteImage offset_to(const ByteImage& image, const ByteImage& reference, const Box& box) {
  assert(image.pixels.size() == reference.pixels.size());
  ByteImage out = image;
  for (int c = 0; c < image.channels; ++c) {
    std::int64_t sum = 0, count = 0;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        if (x >= box.x && x < box.x + box.width && y >= box.y && y < box.y + box.height) continue;
        sum += int{reference.at(x, y, c)} - int{image.at(x, y, c)};
        ++count;
      }
    }
    assert(count > 0);
    const double offset = static_cast<double>(sum) / static_cast<double>(count);
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        out.at(x, y, c) = static_cast<std::uint8_t>(std::clamp(std::round(image.at(x, y, c) + offset), 0.0, 255.0));
  }
  return out;
}

double psnr_ln(double mse) { return -10.0 * std::log(mse); }

}  // namespace tacipc
