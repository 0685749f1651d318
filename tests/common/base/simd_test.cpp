#include "common/base/simd.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace tacipc {
namespace simd_test {

/// Compiled as what production calls is: for each kind of processor.
TACIPC_CLONES void logarithms(const Pack& of, Pack& out) { out = logarithm(of); }

TACIPC_CLONES void exponentials(const Pack& of, Pack& out) { out = exponential(of); }

/// Difference from the exact result, in units in the last place of that.
double error_of(long double exact, double found) {
  const double size = std::abs(static_cast<double>(exact));
  const double unit = std::nextafter(size, std::numeric_limits<double>::infinity()) - size;
  return static_cast<double>(std::abs(found - exact)) / unit;
}

TEST(PackLogarithm, IsWithinTwoUnitsInTheLastPlace) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> from_minus_one_to_one(-1.0, 1.0);
  const auto near_one = [&] {
    return 1.0 + std::ldexp(from_minus_one_to_one(random), -static_cast<int>(random() % 50));
  };
  const auto of_any_size = [&] { return std::exp(700.0 * from_minus_one_to_one(random)); };
  for (int i = 0; i < 20000; ++i) {
    Pack x, found;
    for (int l = 0; l < kLanes; ++l) x[l] = l % 2 == 0 ? near_one() : of_any_size();
    logarithms(x, found);
    for (int l = 0; l < kLanes; ++l) {
      if (x[l] == 1.0 || x[l] <= 0.0) continue;
      ASSERT_LE(error_of(std::log(static_cast<long double>(x[l])), found[l]), 2.0) << x[l];
    }
  }
}

TEST(PackLogarithm, IsExactAtOneAndGoesUpThroughTheSeamsOfItsRange) {
  for (const double seam : {std::sqrt(0.5), std::sqrt(2.0), 1.0, 2.0, 1024.0 * std::sqrt(0.5)}) {
    const double below = std::nextafter(seam, 0.0), above = std::nextafter(seam, 1e300);
    const Pack x = {below, seam, above, 1.0, below, seam, above, 1.0};
    Pack found;
    logarithms(x, found);
    EXPECT_EQ(found[3], 0.0);
    EXPECT_LE(found[0], found[1]);
    EXPECT_LE(found[1], found[2]);
  }
}

TEST(PackExponential, IsWithinTwoUnitsInTheLastPlace) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> from_minus_one_to_one(-1.0, 1.0);
  for (int i = 0; i < 20000; ++i) {
    Pack x, found;
    for (int l = 0; l < kLanes; ++l) x[l] = from_minus_one_to_one(random) * (l % 2 == 0 ? 1.0 : 700.0);
    exponentials(x, found);
    for (int l = 0; l < kLanes; ++l)
      ASSERT_LE(error_of(std::exp(static_cast<long double>(x[l])), found[l]), 2.0) << x[l];
  }
}

TEST(PackExponential, IsOneAtZeroAndStaysAtTheEndsOfItsRange) {
  const Pack x = {0.0, -0.0, 700.0, 701.0, 1e300, -700.0, -701.0, -1e300};
  Pack found;
  exponentials(x, found);
  EXPECT_EQ(found[0], 1.0);
  EXPECT_EQ(found[1], 1.0);
  for (const int l : {3, 4}) EXPECT_EQ(found[l], found[2]);
  for (const int l : {6, 7}) EXPECT_EQ(found[l], found[5]);
}

TEST(PackLogarithm, OfWhatIsNoNormalPositiveNumberIsThatOfTheLibrary) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Pack x = {0.0,    -0.0,
                  -2.0,   kInfinity,
                  1e-310, std::numeric_limits<double>::denorm_min(),
                  3.0,    std::numeric_limits<double>::quiet_NaN()};
  Pack found;
  logarithms(x, found);
  EXPECT_EQ(found[0], -kInfinity);
  EXPECT_EQ(found[1], -kInfinity);
  EXPECT_TRUE(std::isnan(found[2]));
  EXPECT_EQ(found[3], kInfinity);
  EXPECT_EQ(found[4], std::log(1e-310));
  EXPECT_EQ(found[5], std::log(std::numeric_limits<double>::denorm_min()));
  EXPECT_LE(error_of(std::log(3.0L), found[6]), 2.0);
  EXPECT_TRUE(std::isnan(found[7]));
}

}  // namespace simd_test
}  // namespace tacipc
