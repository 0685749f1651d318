#include "stages/object/emboss/picture_relief.h"

#include <gtest/gtest.h>

#include "common/base/error.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace picture_relief_test {

/// 8 × 4 pixels, the upper left quarter white.
ByteImage corner_image() {
  ByteImage image(8, 4, 1, 0);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 4; ++x) image.at(x, y, 0) = 255;
  return image;
}

TEST(PictureHeight, RowZeroIsAtTheTopAndWhiteIsHigh) {
  const Height height = picture_height(corner_image(), {.width_m = 8e-3, .wall_m = 0.2e-3}, "corner.png");
  EXPECT_NEAR(height({-2e-3, 1e-3}), 1.0, 1e-9);
  EXPECT_NEAR(height({2e-3, 1e-3}), 0.0, 1e-9);
  EXPECT_NEAR(height({-2e-3, -1e-3}), 0.0, 1e-9);
  EXPECT_EQ(height({-7e-3, 1e-3}), 0.0);
  EXPECT_EQ(height({0.0, 1.0}), 0.0);
}

TEST(PictureHeight, DarkCanBeHighAndAroundThePictureItIsLow) {
  const Height height =
      picture_height(corner_image(), {.width_m = 8e-3, .wall_m = 0.2e-3, .dark_is_high = true}, "corner.png");
  EXPECT_NEAR(height({-2e-3, 1e-3}), 0.0, 1e-9);
  EXPECT_NEAR(height({2e-3, 1e-3}), 1.0, 1e-9);
  EXPECT_NEAR(height({4.8e-3, 1e-3}), 0.0, 1e-9);
}

TEST(PictureHeight, AStepGetsTheSlopeOfTheWall) {
  ByteImage image(400, 100, 1, 0);
  for (int y = 0; y < 100; ++y)
    for (int x = 200; x < 400; ++x) image.at(x, y, 0) = 255;
  const double wall = 0.5e-3;
  const Height height = picture_height(image, {.width_m = 8e-3, .wall_m = wall}, "step.png");
  const double step = 0.02e-3;
  EXPECT_NEAR((height({step, 0}) - height({-step, 0})) / (2 * step), 1.0 / wall, 0.02 / wall);
  EXPECT_NEAR(height({0, 0}), 0.5, 1e-9);
}

TEST(PictureHeight, OneGreyIsNoRelief) {
  EXPECT_EQ(
      message_of<DataError>([] { picture_height(ByteImage(4, 4, 1, 77), {.width_m = 1e-3, .wall_m = 1e-4}, "p.png"); }),
      "p.png: every pixel has the grey 77, so there is no relief");
}

}  // namespace picture_relief_test
}  // namespace tacipc
