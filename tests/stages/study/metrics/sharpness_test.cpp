#include "stages/study/metrics/sharpness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/stages/study/metrics/test_images.h"

namespace tacipc {
namespace sharpness_test {

/// Stripes of 40 codes about 120 with this period along x.
ByteImage stripes(int period_px) {
  ByteImage image(160, 40, 3);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 3; ++c)
        image.at(x, y, c) =
            static_cast<std::uint8_t>(std::lround(120.0 + 40.0 * std::cos(2.0 * std::numbers::pi * x / period_px)));
  return image;
}

TEST(Sharpness, OfStripesIsTheirAttenuatedCurvature) {
  // cos(k x) becomes exp(-(k sigma)^2 / 2) (2 cos k - 2) cos(k x); its variance over whole periods is half the square.
  const double k = 2.0 * std::numbers::pi / 20.0, sigma = 3.0;
  const double amplitude = 40.0 * std::exp(-0.5 * k * k * sigma * sigma) * (2.0 - 2.0 * std::cos(k));
  EXPECT_NEAR(laplacian_variance(stripes(20), sigma, {40, 0, 80, 40}) / (0.5 * amplitude * amplitude), 1.0, 0.01);
}

TEST(Sharpness, SlopesHaveNoneAndHalfTheContrastAQuarter) {
  ByteImage slope(120, 60, 3), sharp = stripes(20), faint = stripes(20);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 120; ++x)
      for (int c = 0; c < 3; ++c) slope.at(x, y, c) = static_cast<std::uint8_t>(x + y + c);
  EXPECT_NEAR(laplacian_variance(slope, 3.0, {30, 20, 60, 20}), 0.0, 1e-20);
  for (std::uint8_t& code : faint.pixels) code = static_cast<std::uint8_t>(std::lround(120.0 + 0.5 * (code - 120.0)));
  EXPECT_NEAR(sharpness(faint, sharp, {40, 0, 80, 40}), 0.25, 0.005);
  EXPECT_DOUBLE_EQ(sharpness(sharp, sharp, {0, 0, 160, 40}), 1.0);
}

TEST(Sharpness, DependsOnTheBoxAlone) {
  const ByteImage image = pattern_image(90, 60);
  ByteImage other = image;
  for (int y = 0; y < 60; ++y) other.at(2, y, 0) = 0;  // 4 sigma and a pixel away from the box
  EXPECT_EQ(sharpness(other, image, {16, 5, 40, 30}), 1.0);
  EXPECT_NE(sharpness(other, image, {14, 5, 40, 30}), 1.0);
  EXPECT_TRUE(std::isnan(sharpness(ByteImage(20, 20, 3, 7), ByteImage(20, 20, 3, 7), {0, 0, 20, 20})));
}

}  // namespace sharpness_test
}  // namespace tacipc
