#include "stages/image/calibrate/blocks.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <limits>
#include <vector>

namespace tacipc {

FloatImage block_codes(const ByteImage& image, int block) {
  assert(image.width % block == 0 && image.height % block == 0);
  return reduced_blocks(image, block, [](std::vector<std::uint8_t>& codes) {
    std::ranges::sort(codes);
    const std::size_t cut = codes.size() / 4;
    const auto first = codes.begin() + static_cast<std::ptrdiff_t>(cut),
               last = codes.end() - static_cast<std::ptrdiff_t>(cut);
    double sum = 0.0;
    for (auto code = first; code != last; ++code) sum += *code;
    const bool clipped = *first == 0 || *(last - 1) == 255;
    return clipped ? std::numeric_limits<float>::quiet_NaN()
                   : static_cast<float>(sum / static_cast<double>(last - first));
  });
}

}  // namespace tacipc
