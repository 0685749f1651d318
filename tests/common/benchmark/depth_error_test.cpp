#include "common/benchmark/depth_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/base/error.h"

namespace tacipc {
namespace depth_error_test {

constexpr DepthRegions kPressed{.pressed_m = 0.02e-3};

FloatImage map_of(int width, int height, const auto& press) {
  FloatImage map(width, height, 1);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) map.at(x, y, 0) = static_cast<float>(12e-3 - press(x, y));
  return map;
}
const auto kNothing = [](int, int) { return 0.0; };

TEST(DepthError, AMapEqualsItself) {
  const FloatImage map = map_of(20, 10, [](int x, int) { return 0.0101e-3 * x; });
  const DepthErrors errors = depth_errors(map, map, map_of(20, 10, kNothing), kPressed);
  EXPECT_EQ(errors.full.pixels, 200u);
  EXPECT_EQ(errors.pressed.pixels, 180u);  // 18 columns deeper than 0.02 mm
  EXPECT_EQ(errors.full.mae_m, 0.0);
  EXPECT_EQ(errors.full.max_m, 0.0);
  EXPECT_EQ(errors.pressed.slope_ratio, 1.0);
  EXPECT_EQ(errors.full.iou, 1.0);
}

TEST(DepthError, HalfTheDepth) {
  // Pressed by d in half of the image, by d / 2 in the map.
  const auto press = [](double depth) { return [=](int x, int) { return x >= 10 ? depth : 0.0; }; };
  const DepthErrors errors =
      depth_errors(map_of(20, 10, press(0.2e-3)), map_of(20, 10, press(0.4e-3)), map_of(20, 10, kNothing), kPressed);
  EXPECT_NEAR(errors.full.mae_m, 0.1e-3, 1e-8);
  EXPECT_NEAR(errors.pressed.mae_m, 0.2e-3, 1e-8);
  EXPECT_NEAR(errors.pressed.mse_m2, 0.04e-6, 1e-11);
  EXPECT_NEAR(errors.full.mse_m2, 0.02e-6, 1e-11);
  EXPECT_NEAR(errors.full.max_m, 0.2e-3, 1e-8);
  EXPECT_NEAR(errors.full.mae_norm, 0.25, 1e-4);
  EXPECT_NEAR(errors.full.slope_ratio, 0.5, 1e-4);
  EXPECT_TRUE(std::isnan(errors.pressed.slope_ratio)) << "flat there";
  EXPECT_EQ(errors.full.iou, 1.0);
}

TEST(DepthError, MasksThatOverlapByHalf) {
  const auto press = [](int from) { return [=](int x, int) { return x >= from && x < from + 8 ? 0.3e-3 : 0.0; }; };
  const DepthErrors errors =
      depth_errors(map_of(20, 4, press(4)), map_of(20, 4, press(8)), map_of(20, 4, kNothing), kPressed);
  EXPECT_DOUBLE_EQ(errors.full.iou, 4.0 / 12.0);
}

TEST(DepthError, BesideThePress) {
  // Pressed in a block of 4 x 2; the map sees a step of 0.1 mm two pixels to its left, as a shadow may look.
  const auto block = [](int x, int y) { return x >= 8 && x < 12 && y >= 4 && y < 6; };
  const FloatImage reference = map_of(20, 10, [&](int x, int y) { return block(x, y) ? 0.4e-3 : 0.0; });
  const FloatImage map = map_of(20, 10, [&](int x, int y) { return block(x, y) ? 0.4e-3 : x == 6 ? 0.1e-3 : 0.0; });
  const FloatImage rest = map_of(20, 10, kNothing);
  EXPECT_FALSE(depth_errors(map, reference, rest, kPressed).beside);
  const auto within = [](int px) { return DepthRegions{.pressed_m = 0.02e-3, .beside_px = px}; };
  const DepthError one = depth_errors(map, reference, rest, within(1)).beside.value();
  EXPECT_EQ(one.pixels, 6u * 4u - 8u);
  EXPECT_EQ(one.mae_m, 0.0);
  const DepthError three = depth_errors(map, reference, rest, within(3)).beside.value();
  EXPECT_EQ(three.pixels, 10u * 8u - 8u);
  EXPECT_NEAR(three.mae_m, 8 * 0.1e-3 / 72, 1e-9);
  EXPECT_NEAR(three.mse_norm, 8 * 0.01 / 0.16 / 72, 1e-5);
}

TEST(DepthError, ContactIsWhereTheReferenceLiesOnTheObject) {
  // A wedge in columns 6 to 13, 0.1 mm deeper with each; the membrane lies on it from column 9 on, 5 µm above it, and
  // is pressed beside it, too. The map is 0.02 mm too shallow in contact and 0.05 mm elsewhere.
  const auto on = [](int x) { return x >= 9 && x < 14; };
  const auto wedge = [](int x) { return x >= 6 && x < 14 ? 0.1e-3 * (x - 5) : 0.0; };
  const FloatImage surface = map_of(20, 4, [&](int x, int) { return wedge(x); });
  const auto membrane = [&](int x) { return on(x) ? wedge(x) - 5e-6 : 0.03e-3; };
  const FloatImage reference = map_of(20, 4, [&](int x, int) { return membrane(x); });
  const FloatImage map = map_of(20, 4, [&](int x, int) { return membrane(x) - (on(x) ? 0.02e-3 : 0.05e-3); });
  const FloatImage rest = map_of(20, 4, kNothing);
  DepthRegions regions{.pressed_m = 0.02e-3, .contact_m = 0.015e-3, .beside_px = 2};
  EXPECT_FALSE(depth_errors(map, reference, rest, regions).contact);
  const DepthErrors errors = depth_errors(map, reference, rest, regions, &surface);
  EXPECT_EQ(errors.pressed.pixels, 80u);
  EXPECT_EQ(errors.contact.value().pixels, 20u);
  EXPECT_NEAR(errors.contact->mae_m, 0.02e-3, 1e-8);
  EXPECT_EQ(errors.beside.value().pixels, 16u);  // two columns on either side of the contact
  EXPECT_NEAR(errors.beside->mae_m, 0.05e-3, 1e-8);
  regions.contact_m = 0.001e-3;
  EXPECT_THROW(depth_errors(map, reference, rest, regions, &surface), DataError);
}

TEST(DepthError, UnknownPixelsDoNotCount) {
  FloatImage map = map_of(20, 10, [](int x, int) { return x == 5 ? 0.3e-3 : 0.0; });
  const FloatImage reference = map;
  for (int y = 0; y < 10; ++y) map.at(6, y, 0) = std::numeric_limits<float>::quiet_NaN();
  const DepthErrors errors = depth_errors(map, reference, map_of(20, 10, kNothing), kPressed);
  EXPECT_EQ(errors.full.pixels, 190u);
  EXPECT_EQ(errors.full.mae_m, 0.0);
  EXPECT_TRUE(std::isfinite(errors.full.slope_ratio));
}

TEST(DepthError, WithoutAPressThereIsNothingToCompare) {
  const FloatImage flat = map_of(20, 10, kNothing);
  EXPECT_THROW(depth_errors(flat, flat, flat, kPressed), DataError);
}

}  // namespace depth_error_test
}  // namespace tacipc
