#include "stages/image/video/yuv.h"

#include <gtest/gtest.h>

#include <random>

namespace tacipc {
namespace yuv_test {

ByteImage filled(int r, int g, int b) {
  ByteImage image(4, 2, 3);
  for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
    image.pixels[i] = static_cast<std::uint8_t>(r);
    image.pixels[i + 1] = static_cast<std::uint8_t>(g);
    image.pixels[i + 2] = static_cast<std::uint8_t>(b);
  }
  return image;
}

/// Codes of the colour bars as BT.709 has them.
TEST(Yuv, CodesAreThoseOfTheStandard) {
  const struct {
    int r, g, b, y, cb, cr;
  } bars[] = {{255, 255, 255, 235, 128, 128}, {0, 0, 0, 16, 128, 128},   {255, 0, 0, 63, 102, 240},
              {0, 255, 0, 173, 42, 26},       {0, 0, 255, 32, 240, 118}, {255, 255, 0, 219, 16, 138}};
  for (const auto& bar : bars) {
    const YuvImage yuv = yuv_of(filled(bar.r, bar.g, bar.b));
    ASSERT_EQ(yuv.y.size(), 8u);
    ASSERT_EQ(yuv.cb.size(), 2u);
    EXPECT_EQ(yuv.y[5], bar.y);
    EXPECT_EQ(yuv.cb[1], bar.cb);
    EXPECT_EQ(yuv.cr[1], bar.cr);
  }
}

TEST(Yuv, TheWayBackIsRightToTheRoundingOfCodes) {
  std::mt19937 random(2);
  std::uniform_int_distribution<int> code(0, 255);
  for (int i = 0; i < 300; ++i) {
    const ByteImage image = filled(code(random), code(random), code(random)), back = rgb_of(yuv_of(image));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(back.at(1, 1, c), image.at(1, 1, c), 2.0);
  }
}

TEST(Yuv, ColourIsTheMeanOfFourPixelsAndBrightnessOfEach) {
  ByteImage image = filled(100, 100, 100);
  image.at(0, 0, 0) = 180;
  const YuvImage yuv = yuv_of(image), even = yuv_of(filled(120, 100, 100));
  EXPECT_EQ(yuv.cr[0], even.cr[0]);
  EXPECT_GT(yuv.y[0], yuv.y[1]);
  EXPECT_EQ(yuv.cr[1], 128);
}

}  // namespace yuv_test
}  // namespace tacipc
