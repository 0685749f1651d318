#include "stages/image/track/dot_center.h"

#include <gtest/gtest.h>

#include <numbers>

#include "stages/image/track/find_dots.h"
#include "stages/image/track/light_image.h"
#include "tests/stages/image/track/drawn_dots.h"

namespace tacipc {
namespace dot_center_test {

constexpr double kRadius = 4.0;

TEST(LightImage, UndoesTheCurve) {
  ByteImage image(2, 1, 3);
  image.at(0, 0, 0) = image.at(0, 0, 1) = image.at(0, 0, 2) = 188;  // half of full light in sRGB
  image.at(1, 0, 0) = 255;
  EXPECT_NEAR(light_of(image, "srgb").at(0, 0, 0), 0.5029, 1e-4);
  EXPECT_NEAR(light_of(image, "linear").at(0, 0, 0), 188.0 / 255.0, 1e-6);
  EXPECT_NEAR(light_of(image, "srgb").at(1, 0, 0), 1.0 / 3.0, 1e-6);
}

TEST(DotCenter, IsExactWhereverTheDotLiesBetweenPixels) {
  for (const double part : {0.0, 0.13, 0.5, 0.77}) {
    const Eigen::Vector2d center(20.0 + part, 18.0 - 0.4 * part);
    const FloatImage light = light_of(drawn_dots(40, 36, {center}, kRadius, 0.1, even_light), "srgb");
    const auto dot = dot_center(light, center + Eigen::Vector2d(1.2, -0.9), DotWindow::of(2 * kRadius, 1e9), 0.3);
    ASSERT_TRUE(dot) << part;
    EXPECT_NEAR((dot->px - center).norm(), 0.0, 0.01) << part;
    EXPECT_NEAR(dot->diameter_px(), 2 * kRadius, 0.1);
    EXPECT_NEAR(dot->contrast, 0.9, 0.02);
  }
}

TEST(DotCenter, AnEvenSlopeOfLightDoesNotShiftIt) {
  const Eigen::Vector2d center(20.3, 18.6);
  const auto slope = [](double x, double y) { return 0.2 + 0.012 * x + 0.004 * y; };
  const FloatImage light = light_of(drawn_dots(40, 36, {center}, kRadius, 0.1, slope), "srgb");
  const auto dot = dot_center(light, {20, 18}, DotWindow::of(2 * kRadius, 1e9), 0.3);
  ASSERT_TRUE(dot);
  EXPECT_NEAR((dot->px - center).norm(), 0.0, 0.03);
}

TEST(DotCenter, NeighboursInTheRingDoNotShiftIt) {
  const std::vector<Eigen::Vector2d> centers{{20.3, 18.6}, {32.3, 18.6}, {20.3, 30.6}};
  const FloatImage light = light_of(drawn_dots(44, 40, centers, kRadius, 0.1, even_light), "srgb");
  const auto dot = dot_center(light, {20, 18}, DotWindow::of(2 * kRadius, 12.0), 0.3);
  ASSERT_TRUE(dot);
  EXPECT_NEAR((dot->px - centers[0]).norm(), 0.0, 0.02);
}

TEST(DotCenter, NothingWhereThereIsNoDotOrNoRoom) {
  const FloatImage light = light_of(drawn_dots(40, 36, {{20, 18}, {3, 18}}, kRadius, 0.8, even_light), "srgb");
  const DotWindow window = DotWindow::of(2 * kRadius, 1e9);
  EXPECT_TRUE(dot_center(light, {20, 18}, window, 0.15));
  EXPECT_FALSE(dot_center(light, {20, 18}, window, 0.3));  // too faint
  EXPECT_FALSE(dot_center(light, {30, 18}, window, 0.15));
  EXPECT_FALSE(dot_center(light, {3, 18}, window, 0.15));  // cut by the edge
  EXPECT_FALSE(dot_center(light, {std::nan(""), 18}, window, 0.15));
}

TrackConfig config() { return {.least_diameter_px = 4, .most_diameter_px = 16}; }

TEST(FindDots, InReadingOrderWithoutWhatIsNoDot) {
  std::vector<Eigen::Vector2d> centers = dot_grid(3, 4, 14.0, {12.3, 13.1});
  for (std::size_t i = 0; i < centers.size(); ++i) centers[i].y() += 0.3 * static_cast<double>(i % 3);
  const auto stripe = [](double x, double y) {
    return (x > 64 && x < 68 && y > 10 && y < 50) ? 0.05 : 0.3 + 0.002 * x;
  };
  const std::vector<DotCenter> dots =
      find_dots(light_of(drawn_dots(80, 60, centers, 3.0, 0.1, stripe), "srgb"), config());
  ASSERT_EQ(dots.size(), centers.size());
  for (std::size_t i = 0; i < dots.size(); ++i) EXPECT_LT((dots[i].px - centers[i]).norm(), 0.03) << i;
  TrackConfig wide = config();
  wide.least_diameter_px = 8;
  EXPECT_TRUE(find_dots(light_of(drawn_dots(80, 60, centers, 3.0, 0.1, even_light), "srgb"), wide).empty());
}

}  // namespace dot_center_test
}  // namespace tacipc
