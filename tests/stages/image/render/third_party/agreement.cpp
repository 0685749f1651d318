#include "tests/stages/image/render/third_party/agreement.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "common/optics/develop.h"

namespace tacipc {

double relative_rmse(const FloatImage& ours, const FloatImage& theirs) {
  assert(ours.pixels.size() == theirs.pixels.size());
  double squared = 0.0, error = 0.0;
  for (std::size_t i = 0; i < ours.pixels.size(); ++i) {
    const double value = ours.pixels[i], difference = theirs.pixels[i] - value;
    squared += value * value;
    error += difference * difference;
  }
  assert(squared > 0.0);
  return std::sqrt(error / squared);
}

FloatImage halved(const FloatImage& image) {
  assert(image.width % 2 == 0 && image.height % 2 == 0);
  FloatImage out(image.width / 2, image.height / 2, image.channels);
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x)
      for (int c = 0; c < out.channels; ++c)
        out.at(x, y, c) = 0.25f * (image.at(2 * x, 2 * y, c) + image.at(2 * x + 1, 2 * y, c) +
                                   image.at(2 * x, 2 * y + 1, c) + image.at(2 * x + 1, 2 * y + 1, c));
  return out;
}

ByteImage side_by_side(const FloatImage& ours, const FloatImage& theirs, double span) {
  const double white = *std::max_element(ours.pixels.begin(), ours.pixels.end());
  const Response srgb{.curve = "srgb"};
  const auto code = [](double value) { return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0))); };
  const FloatImage left = halved(ours), right = halved(theirs);
  const int width = left.width, height = left.height;
  ByteImage out(3 * width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) {
        const double a = left.at(x, y, c) / white, b = right.at(x, y, c) / white;
        out.at(x, y, c) = code(code_of(a, srgb));
        out.at(width + x, y, c) = code(code_of(b, srgb));
        out.at(2 * width + x, y, c) = code(127.5 * (1.0 + (b - a) / span));
      }
  return out;
}

}  // namespace tacipc
