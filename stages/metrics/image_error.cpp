#include "stages/metrics/image_error.h"

#include <cassert>
#include <cmath>
#include <cstdlib>

namespace tacipc {

ImageError image_error(const ByteImage& a, const ByteImage& b) {
  assert(a.pixels.size() == b.pixels.size() && !a.pixels.empty());
  // Whole numbers: exact in any order.
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

double psnr_db(double mse) { return -10.0 * std::log10(mse); }

double psnr_ln(double mse) { return -10.0 * std::log(mse); }

}  // namespace tacipc
