#include "stages/image/video/yuv.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tacipc {
namespace {

constexpr double kRed = 0.2126, kGreen = 0.7152, kBlue = 0.0722;

std::uint8_t code(double value) { return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0))); }

double luma(double r, double g, double b) { return kRed * r + kGreen * g + kBlue * b; }

}  // namespace

YuvImage yuv_of(const ByteImage& image) {
  assert(image.channels == 3 && image.width % 2 == 0 && image.height % 2 == 0);
  const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  YuvImage out{image.width, image.height, {}, {}, {}};
  out.y.reserve(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const std::uint8_t* p = &image.pixels[3 * i];
    out.y.push_back(code(16.0 + 219.0 / 255.0 * luma(p[0], p[1], p[2])));
  }
  for (int y = 0; y < image.height; y += 2) {
    for (int x = 0; x < image.width; x += 2) {
      double mean[3];
      for (int c = 0; c < 3; ++c)
        mean[c] =
            (image.at(x, y, c) + image.at(x + 1, y, c) + image.at(x, y + 1, c) + image.at(x + 1, y + 1, c)) / 1020.0;
      const double e = luma(mean[0], mean[1], mean[2]);
      out.cb.push_back(code(128.0 + 112.0 * (mean[2] - e) / (1.0 - kBlue)));
      out.cr.push_back(code(128.0 + 112.0 * (mean[0] - e) / (1.0 - kRed)));
    }
  }
  return out;
}

ByteImage rgb_of(const YuvImage& image) {
  ByteImage out(image.width, image.height, 3);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const std::size_t at = static_cast<std::size_t>(y) * image.width + x;
      const std::size_t half = static_cast<std::size_t>(y / 2) * (image.width / 2) + x / 2;
      const double e = (image.y[at] - 16.0) / 219.0;
      const double r = e + (image.cr[half] - 128.0) / 112.0 * (1.0 - kRed);
      const double b = e + (image.cb[half] - 128.0) / 112.0 * (1.0 - kBlue);
      const double g = (e - kRed * r - kBlue * b) / kGreen;
      out.at(x, y, 0) = code(255.0 * r), out.at(x, y, 1) = code(255.0 * g), out.at(x, y, 2) = code(255.0 * b);
    }
  }
  return out;
}

}  // namespace tacipc
