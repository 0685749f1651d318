#include "common/image/picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace tacipc {
namespace picture_test {

/// Relative luminance of an sRGB colour.
double luminance(const std::array<std::uint8_t, 3>& color) {
  const auto linear = [](std::uint8_t code) {
    const double v = code / 255.0;
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(color[0]) + 0.7152 * linear(color[1]) + 0.0722 * linear(color[2]);
}

TEST(PerceptualColor, GrowsLighterInEvenSteps) {
  double before = -1.0;
  for (int i = 0; i <= 100; ++i) {
    // Lightness L* of CIE 1976: even steps of t must stay even there too, within a half.
    const double y = luminance(perceptual_color(i / 100.0));
    const double lightness = y > 0.008856 ? 116.0 * std::cbrt(y) - 16.0 : 903.3 * y;
    if (i > 0) {
      EXPECT_GT(lightness - before, 0.45) << i;
      EXPECT_LT(lightness - before, 1.35) << i;
    }
    before = lightness;
  }
  EXPECT_EQ(perceptual_color(-3.0), perceptual_color(0.0));
  EXPECT_EQ(perceptual_color(7.0), perceptual_color(1.0));
}

TEST(PictureOfScalar, SpansLowToHighAndShowsNothingAsBlack) {
  FloatImage image(4, 1, 1);
  image.pixels = {2.0f, 3.0f, 9.0f, std::numeric_limits<float>::quiet_NaN()};
  const ByteImage picture = picture_of_scalar(image, 2.0, 4.0);
  const std::array<double, 3> expected{0.0, 0.5, 1.0};
  for (int x = 0; x < 3; ++x) {
    const auto color = perceptual_color(expected[static_cast<std::size_t>(x)]);
    for (int c = 0; c < 3; ++c) EXPECT_EQ(picture.at(x, 0, c), color[static_cast<std::size_t>(c)]) << x;
  }
  for (int c = 0; c < 3; ++c) EXPECT_EQ(picture.at(3, 0, c), 0);
}

TEST(PictureOfNormals, MapsMinusOneToOneOntoTheCodes) {
  FloatImage normals(2, 1, 3);
  normals.pixels = {0.0f, -1.0f, 1.0f, 0.5f, -0.5f, std::numeric_limits<float>::quiet_NaN()};
  EXPECT_EQ(picture_of_normals(normals).pixels, (std::vector<std::uint8_t>{128, 0, 255, 191, 64, 0}));
}

}  // namespace picture_test
}  // namespace tacipc
