#include "stages/object/emboss/texture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/base/rng.h"

namespace tacipc {
namespace texture_test {

Vector2 random_point(std::uint64_t i) {
  return 10.0 * Vector2(random_uniform(1, 0, i) - 0.5, random_uniform(1, 1, i) - 0.5);
}

TEST(GradientNoise, VanishesOnTheLatticeAndKeepsItsRange) {
  double low = 0.0, high = 0.0;
  for (int i = -3; i <= 3; ++i) EXPECT_EQ(gradient_noise(Vector2(i, 2 * i), 5, 0), 0.0);
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const double value = gradient_noise(random_point(i), 5, 0);
    low = std::min(low, value);
    high = std::max(high, value);
  }
  EXPECT_GE(low, -1.0);
  EXPECT_LE(high, 1.0);
  EXPECT_LT(low, -0.6);
  EXPECT_GT(high, 0.6);
}

TEST(GradientNoise, IsContinuousAcrossSquares) {
  for (const double at : {-2.0, 0.0, 3.0}) {
    EXPECT_NEAR(gradient_noise({at - 1e-9, 0.3}, 5, 0), gradient_noise({at + 1e-9, 0.3}, 5, 0), 1e-8);
    EXPECT_NEAR(gradient_noise({0.7, at - 1e-9}, 5, 0), gradient_noise({0.7, at + 1e-9}, 5, 0), 1e-8);
  }
}

TEST(GradientNoise, DependsOnSeedAndStream) {
  EXPECT_NE(gradient_noise({0.3, 0.4}, 1, 0), gradient_noise({0.3, 0.4}, 2, 0));
  EXPECT_NE(gradient_noise({0.3, 0.4}, 1, 0), gradient_noise({0.3, 0.4}, 1, 1));
}

TEST(Textures, HeightsStayBetweenFloorAndTopAndUseTheRange) {
  const std::vector<Height> textures = {[](const Vector2& p) { return stone_height(p, 1.0, 4, 2.4, 9); },
                                        [](const Vector2& p) { return weave_height(p, 0.7, 0.9); },
                                        [](const Vector2& p) { return ridges_height(p, 0.5, 0.6, 2.0, 9); }};
  for (const Height& height : textures) {
    double low = 1.0, high = 0.0;
    for (std::uint64_t i = 0; i < 5000; ++i) {
      const double value = height(random_point(i));
      low = std::min(low, value);
      high = std::max(high, value);
    }
    EXPECT_GE(low, 0.0);
    EXPECT_LE(high, 1.0);
    EXPECT_LT(low, 0.05);
    EXPECT_GT(high, 0.95);
  }
}

TEST(WeaveHeight, StrandsCrossOverAndUnderInTurn) {
  // In square (0, 0) the horizontal strand is on top, in (1, 0) the vertical one.
  EXPECT_NEAR(weave_height({0.5, 0.5}, 1.0, 0.8), 1.0, 1e-12);
  EXPECT_NEAR(weave_height({1.5, 0.5}, 1.0, 0.8), 1.0, 1e-12);
  const double off = 0.2;  // next to a strand's crown its section is lower: only across, not along
  const double section = 1.0 - (2 * off / 0.8) * (2 * off / 0.8);
  EXPECT_NEAR(weave_height({0.5, 0.5 + off}, 1.0, 0.8), section, 1e-12);
  EXPECT_NEAR(weave_height({1.5 + off, 0.5}, 1.0, 0.8), section, 1e-12);
  EXPECT_EQ(weave_height({1.0, 1.0}, 1.0, 0.8), 0.0);  // the hole between four strands
}

TEST(RidgesHeight, WithoutBendIsAnOvalWhorl) {
  EXPECT_DOUBLE_EQ(ridges_height({0, 0}, 0.5, 0.0, 1.0, 0), 1.0);
  EXPECT_NEAR(ridges_height({0.25 / 1.2, 0}, 0.5, 0.0, 1.0, 0), 0.0, 1e-12);
  EXPECT_NEAR(ridges_height({0, -0.5 / 0.8}, 0.5, 0.0, 1.0, 0), 1.0, 1e-12);
}

}  // namespace texture_test
}  // namespace tacipc
