#include "common/image/picture.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "common/base/tone_curve.h"

namespace tacipc {
namespace {

std::uint8_t srgb_code(double linear) {
  return static_cast<std::uint8_t>(std::lround(ToneCurve{}.code_of(std::clamp(linear, 0.0, 1.0))));
}

double cube(double v) { return v * v * v; }

std::uint8_t unit_code(double value) {
  return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(value, 0.0, 1.0)));
}

}  // namespace

std::array<std::uint8_t, 3> perceptual_color(double t) {
  t = std::clamp(t, 0.0, 1.0);
  const double lightness = 0.22 + 0.73 * t;
  const double hue = (290.0 - 185.0 * t) * std::numbers::pi / 180.0;
  // Chroma varies so that every colour stays inside sRGB: the gamut is narrow in dark and teal tones.
  const double chroma = 0.095 + 0.055 * t - 0.03 * std::sin(std::numbers::pi * t);
  const double a = chroma * std::cos(hue), b = chroma * std::sin(hue);
  const double l = cube(lightness + 0.3963377774 * a + 0.2158037573 * b);
  const double m = cube(lightness - 0.1055613458 * a - 0.0638541728 * b);
  const double s = cube(lightness - 0.0894841775 * a - 1.2914855480 * b);
  return {srgb_code(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          srgb_code(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          srgb_code(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

ByteImage picture_of_scalar(const FloatImage& image, double low, double high) {
  assert(low < high);
  ByteImage picture(image.width, image.height, 3);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const double value = image.at(x, y, 0);
      if (std::isnan(value)) continue;
      const auto color = perceptual_color((value - low) / (high - low));
      for (int c = 0; c < 3; ++c) picture.at(x, y, c) = color[c];
    }
  }
  return picture;
}

ByteImage picture_of_height(const FloatImage& image) {
  double most = 1e-6;
  for (const float value : image.pixels) {
    if (value > most) most = value;
  }
  return picture_of_scalar(image, 0.0, most);
}

ByteImage picture_of_normals(const FloatImage& normals) {
  assert(normals.channels == 3);
  ByteImage picture(normals.width, normals.height, 3);
  for (std::size_t i = 0; i < normals.pixels.size(); ++i) {
    const double value = normals.pixels[i];
    if (!std::isnan(value)) picture.pixels[i] = unit_code(0.5 * (value + 1.0));
  }
  return picture;
}

FloatImage means_over_squares(const ByteImage& image, int by) {
  FloatImage out((image.width + by - 1) / by, (image.height + by - 1) / by, image.channels);
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x)
      for (int c = 0; c < out.channels; ++c) {
        int sum = 0, count = 0;
        for (int j = by * y; j < std::min(by * (y + 1), image.height); ++j)
          for (int i = by * x; i < std::min(by * (x + 1), image.width); ++i, ++count) sum += image.at(i, j, c);
        out.at(x, y, c) = static_cast<float>(sum) / static_cast<float>(count);
      }
  return out;
}

ByteImage reduced(const ByteImage& picture, int by) {
  if (by == 1) return picture;
  const FloatImage means = means_over_squares(picture, by);
  ByteImage out(means.width, means.height, means.channels);
  std::ranges::transform(means.pixels, out.pixels.begin(),
                         [](float mean) { return static_cast<std::uint8_t>(std::lround(mean)); });
  return out;
}

void paste(ByteImage& sheet, const ByteImage& picture, int x, int y) {
  assert(sheet.channels == 3 && picture.channels == 3 && x + picture.width <= sheet.width &&
         y + picture.height <= sheet.height);
  const std::size_t row = 3 * static_cast<std::size_t>(picture.width);
  for (int line = 0; line < picture.height; ++line)
    std::copy_n(&picture.at(0, line, 0), row, &sheet.at(x, y + line, 0));
}

}  // namespace tacipc
