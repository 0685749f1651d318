#include "stages/rival/baseline/shadows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/sensor/light_field.h"
#include "stages/rival/baseline/kernel.h"

namespace tacipc {
namespace shadows_test {

constexpr int kWidth = 60, kHeight = 40;
constexpr double kPixelM = 0.1e-3;

/// Lists of −30, −30, … for every direction within 0.25 rad of +x (indices 0 to 2 and 61, 62), red alone, of one depth.
ShadowTable to_the_right(int steps, int depth) {
  ShadowTable table{.directions = 63, .depths = 9, .steps = steps, .codes = {}};
  table.codes.assign(static_cast<std::size_t>(3 * 63 * 9 * steps), 0.0);
  for (const int direction : {0, 1, 2, 61, 62})
    std::fill_n(table.codes.begin() + (direction * 9 + depth) * steps, steps, -30.0);
  return table;
}

/// A ridge along y at x = 20, 0.75 mm deep, which falls by 0.03 mm per pixel to both sides.
Raster ridge() {
  Raster height(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) height.at(x, y) = 0.75e-3 * std::max(0.0, 1.0 - 0.04 * std::abs(x - 20));
  return height;
}

std::vector<bool> column(int at) {
  std::vector<bool> contact(kWidth * kHeight, false);
  for (int y = 0; y < kHeight; ++y) contact[static_cast<std::size_t>(y * kWidth + at)] = true;
  return contact;
}

TEST(Ring, IsFourPixelsWideAndKeepsItsLength) {
  std::vector<bool> contact(kWidth * kHeight, false);
  contact[20 * kWidth + 30] = true;
  EXPECT_EQ(std::ranges::count(ring_around(contact, kWidth, kHeight, 1.0), true), 9 * 9 - 1);
  EXPECT_EQ(std::ranges::count(ring_around(contact, kWidth, kHeight, 0.5), true), 5 * 5 - 1);
  EXPECT_FALSE(ring_around(contact, kWidth, kHeight, 1.0)[20 * kWidth + 30]);
}

// Where blurs reach no other code, far inside the shadow, the code is the list's; on the lamp's side nothing changes.
TEST(Shadows, FallDownhillAsFarAsTheListGoes) {
  FloatImage change(kWidth, kHeight, 3);
  // At the ring's outer pixel, x = 24, the membrane is 0.63 mm deep: index 6 + floor(2.3) = 8.
  cast_shadows(change, to_the_right(25, 8), ridge(), column(20), kPixelM, 1.0);
  EXPECT_NEAR(change.at(38, 20, 0), -30.0, 0.1);
  EXPECT_NEAR(change.at(10, 20, 0), 0.0, 1e-6) << "uphill";
  EXPECT_NEAR(change.at(38, 20, 1), 0.0, 1e-6) << "another channel";
  EXPECT_NEAR(change.at(59, 20, 0), 0.0, 1.0);  // 24 + 24 · 1.25 = 54
  FloatImage shorter(kWidth, kHeight, 3);
  cast_shadows(shorter, to_the_right(9, 8), ridge(), column(20), kPixelM, 1.0);
  EXPECT_NEAR(shorter.at(42, 20, 0), 0.0, 0.5);  // 24 + 8 · 1.25 = 34
  EXPECT_NEAR(shorter.at(29, 20, 0), -30.0, 1.0);
}

TEST(Shadows, OfOtherDepthsAreNotTaken) {
  FloatImage change(kWidth, kHeight, 3);
  cast_shadows(change, to_the_right(25, 3), ridge(), column(20), kPixelM, 1.0);  // 0.1 to 0.2 mm
  EXPECT_NEAR(change.at(38, 20, 0), 0.0, 1e-6);
}

TEST(Shadows, DarkenWhatIsBrighterAlone) {
  FloatImage change(kWidth, kHeight, 3);
  std::fill(change.pixels.begin(), change.pixels.end(), -50.0F);
  cast_shadows(change, to_the_right(25, 8), ridge(), column(20), kPixelM, 1.0);
  for (const float code : change.pixels) EXPECT_NEAR(double{code}, -50.0, 1e-4);
}

// Without a contact all that is left are the two blurs of the image: σ 2 and [1 4 6 4 1]/16.
TEST(Shadows, AreBlurredAsReleased) {
  FloatImage change(kWidth, kHeight, 3);
  change.at(30, 20, 2) = 1000.0F;
  cast_shadows(change, to_the_right(5, 8), Raster(kWidth, kHeight), std::vector<bool>(kWidth * kHeight, false), kPixelM,
               1.0);
  double sum = 0.0, second = 0.0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      sum += double{change.at(x, y, 2)};
      second += double{change.at(x, y, 2)} * (x - 30) * (x - 30);
    }
  EXPECT_NEAR(sum, 1000.0, 1.0);
  EXPECT_NEAR(second / sum, 2.0 * 2.0 + 1.0, 0.1);  // variances add
}

}  // namespace shadows_test
}  // namespace tacipc
