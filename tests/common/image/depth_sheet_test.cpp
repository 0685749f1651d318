#include "common/image/depth_sheet.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "common/image/picture.h"

namespace tacipc {
namespace depth_sheet_test {

TEST(DepthSheet, ReducesWidePicturesToMeans) {
  // 401 x 5 pixels become 134 x 2: means of 3 x 3, less at the right and below.
  DepthRow row{
      .image = ByteImage(401, 5, 3), .truth_mm = FloatImage(401, 5, 1, 0.5F), .depth_mm = FloatImage(401, 5, 1, 0.5F)};
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 401; ++x) row.image.at(x, y, 1) = static_cast<std::uint8_t>((x * 7 + y * 31) % 200);
  const ByteImage sheet = depth_sheet({row, row});
  ASSERT_EQ(sheet.width, 4 * 134 + 3 * 4);
  ASSERT_EQ(sheet.height, 2 * 2 + 4);
  const auto mean = [&](int x, int y) {
    double sum = 0.0, count = 0.0;
    for (int j = 3 * y; j < std::min(5, 3 * y + 3); ++j)
      for (int i = 3 * x; i < std::min(401, 3 * x + 3); ++i) sum += row.image.at(i, j, 1), count += 1.0;
    return sum / count;
  };
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 134; ++x) {
      EXPECT_NEAR(sheet.at(x, y, 1), mean(x, y), 0.51) << x << ' ' << y;
      EXPECT_EQ(sheet.at(x, y + 6, 1), sheet.at(x, y, 1));
    }
  // The deepest truth is the lightest, no error the middle.
  for (int c = 0; c < 3; ++c) {
    EXPECT_EQ(sheet.at(138 + 60, 1, c), perceptual_color(1.0)[static_cast<std::size_t>(c)]);
    EXPECT_EQ(sheet.at(2 * 138 + 60, 1, c), perceptual_color(1.0)[static_cast<std::size_t>(c)]);
    EXPECT_EQ(sheet.at(3 * 138 + 60, 1, c), perceptual_color(0.5)[static_cast<std::size_t>(c)]);
  }
}

}  // namespace depth_sheet_test
}  // namespace tacipc
