#include "common/image/axis.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace tacipc {
namespace axis_test {

TEST(RoundAxis, CoversTheRangeWithRoundTicks) {
  const Axis axis = round_axis(-0.05, 0.45, 7);
  EXPECT_DOUBLE_EQ(axis.low, -0.1);
  EXPECT_DOUBLE_EQ(axis.high, 0.5);
  EXPECT_DOUBLE_EQ(axis.step, 0.1);
  EXPECT_EQ(axis.decimals, 1);
  EXPECT_EQ(axis.num_ticks(), 7);
}

TEST(RoundAxis, ABoundOnATickNeedsNoFurtherOne) {
  const Axis axis = round_axis(0.0, 0.1 + 0.2, 4);  // 0.30000000000000004
  EXPECT_DOUBLE_EQ(axis.high, 0.3);
  EXPECT_EQ(axis.num_ticks(), 4);
}

TEST(RoundAxis, CoversAnyRangeWithinTheNumberOfTicks) {
  for (const double size : {1e-9, 0.03, 0.7, 1.0, 4.9, 12345.0}) {
    for (const double start : {-2.0, -0.4, 0.0, 0.9}) {
      for (const int max_ticks : {3, 5, 8}) {
        const double low = start * size, high = low + size;
        const Axis axis = round_axis(low, high, max_ticks);
        SCOPED_TRACE(::testing::Message() << low << " to " << high << " in " << max_ticks);
        EXPECT_LE(axis.low, low + 1e-8 * size);
        EXPECT_GE(axis.high, high - 1e-8 * size);
        EXPECT_LE(axis.num_ticks(), max_ticks);
        EXPECT_LT(axis.high - axis.low, 6 * size);
        EXPECT_NEAR(axis.tick(axis.num_ticks() - 1), axis.high, 1e-9 * size);
      }
    }
  }
}

TEST(RoundAxis, APointGetsAnAxisToo) {
  EXPECT_DOUBLE_EQ(round_axis(0.0, 0.0, 7).low, 0.0);
  EXPECT_GT(round_axis(0.0, 0.0, 7).high, 0.0);
  EXPECT_LE(round_axis(-3.0, -3.0, 7).low, -3.0);
  EXPECT_GT(round_axis(-3.0, -3.0, 7).high, -3.0);
}

TEST(RoundAxis, AnAxisThatEndsBetweenTicksHasThoseBelow) {
  const Axis axis{.low = 0.0, .high = 24.0, .step = 5.0, .decimals = 0};
  EXPECT_EQ(axis.num_ticks(), 5);
  EXPECT_EQ(axis.tick_text(4), "20");
  EXPECT_EQ((Axis{.low = -0.3, .high = 0.3, .step = 0.1, .decimals = 1}.tick_text(3)), "0.0");  // not -0.0
}

TEST(DecadeAxis, HasWholePowersOfTen) {
  const Axis axis = decade_axis(3e-7, 2e-4, 7);
  EXPECT_DOUBLE_EQ(axis.low, -7.0);
  EXPECT_DOUBLE_EQ(axis.high, -3.0);
  EXPECT_DOUBLE_EQ(axis.step, 1.0);
  EXPECT_DOUBLE_EQ(decade_axis(1e-3, 1e-3, 7).high, -3.0);  // a bound on a tick needs no further one
  EXPECT_DOUBLE_EQ(decade_axis(1e-3, 1e-3, 7).low, -4.0);
}

TEST(DecadeAxis, CoversWideRangesWithinTheNumberOfTicks) {
  for (const double low : {1e-300, 1e-16, 1e-9, 0.5}) {
    for (const int max_ticks : {3, 7}) {
      const Axis axis = decade_axis(low, 1.0, max_ticks);
      SCOPED_TRACE(::testing::Message() << low << " in " << max_ticks);
      EXPECT_LE(axis.num_ticks(), max_ticks);
      EXPECT_DOUBLE_EQ(axis.high, 0.0);
      EXPECT_LE(axis.low, std::max(std::log10(low), -12.0));
      EXPECT_EQ(axis.step, std::round(axis.step));
    }
  }
}

TEST(TicksInside, AreRoundAndInside) {
  EXPECT_EQ(ticks_inside(0.0, 1.0), (std::vector<double>{0.0, 0.2, 0.4, 0.6000000000000001, 0.8, 1.0}));
  EXPECT_EQ(ticks_inside(0.0, 0.037).size(), 4u);
  EXPECT_EQ(ticks_inside(-0.9, 1.1), (std::vector<double>{-0.5, 0.0, 0.5, 1.0}));
}

TEST(TicksInside, OfLogarithmsAreOneTwoAndFiveOrDecades) {
  const std::vector<double> ticks = decade_ticks_inside(std::log10(0.004), std::log10(0.04));
  ASSERT_EQ(ticks.size(), 3u);
  for (const std::size_t i : {0u, 1u, 2u})
    EXPECT_NEAR(std::pow(10.0, ticks[i]), (std::array{0.005, 0.01, 0.02})[i], 1e-12);
  EXPECT_EQ(decade_ticks_inside(0.0, 4.0), (std::vector<double>{0.0, 1.0, 2.0, 3.0, 4.0}));
}

TEST(Scale, PlacesValuesBetweenItsEnds) {
  const Scale scale{round_axis(-1.0, 3.0, 7), 100.0, 20.0};
  EXPECT_DOUBLE_EQ(scale.place(-1.0).value(), 100.0);
  EXPECT_DOUBLE_EQ(scale.place(3.0).value(), 20.0);
  EXPECT_DOUBLE_EQ(scale.place(1.0).value(), 60.0);
  EXPECT_FALSE(scale.place(std::nan("")));
  EXPECT_FALSE(scale.place(std::nullopt));
}

TEST(Scale, OfLogarithmsHasNoPlaceForZero) {
  const Scale scale{decade_axis(1e-4, 1.0, 7), 0.0, 40.0, true};
  EXPECT_DOUBLE_EQ(scale.place(1e-3).value(), 10.0);
  EXPECT_DOUBLE_EQ(scale.place(1e-9).value(), 0.0) << "what is too small lies at the lower end";
  EXPECT_FALSE(scale.place(0.0));
  EXPECT_EQ(scale.tick_text(1), "1e-3");
}

TEST(RoundBelow, IsOneTwoOrFive) {
  for (const auto& [value, expected] :
       {std::pair{0.34, 0.2}, {0.2, 0.2}, {0.5, 0.5}, {9.9, 5.0}, {1000.0, 1000.0}, {0.0019, 0.001}})
    EXPECT_DOUBLE_EQ(round_below(value), expected) << value;
}

}  // namespace axis_test
}  // namespace tacipc
