#include "stages/calibrate/block_codes.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <limits>
#include <vector>

namespace tacipc {

FloatImage block_codes(const ByteImage& image, int block) {
  assert(image.width % block == 0 && image.height % block == 0);
  FloatImage out(image.width / block, image.height / block, image.channels);
  std::vector<std::uint8_t> codes;
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x)
      for (int c = 0; c < image.channels; ++c) {
        codes.clear();
        for (int v = 0; v < block; ++v)
          for (int u = 0; u < block; ++u) codes.push_back(image.at(x * block + u, y * block + v, c));
        std::sort(codes.begin(), codes.end());
        const std::size_t cut = codes.size() / 4;
        const auto first = codes.begin() + static_cast<std::ptrdiff_t>(cut),
                   last = codes.end() - static_cast<std::ptrdiff_t>(cut);
        double sum = 0.0;
        for (auto code = first; code != last; ++code) sum += *code;
        const bool clipped = *first == 0 || *(last - 1) == 255;
        out.at(x, y, c) = clipped ? std::numeric_limits<float>::quiet_NaN()
                                  : static_cast<float>(sum / static_cast<double>(last - first));
      }
  return out;
}

}  // namespace tacipc
