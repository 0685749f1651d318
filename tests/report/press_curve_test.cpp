#include "stages/report/press_curve.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <regex>

namespace tacipc {
namespace {

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

/// Position on the drawing and value, read from the ticks' labels alone.
struct Tick {
  double at, value;
};
std::vector<Tick> ticks(const std::string& svg, const std::string& kind, const std::string& coordinate) {
  std::vector<Tick> found;
  const std::regex pattern("<text class=\"" + kind + "\"[^>]* " + coordinate +
                           "=\"([-0-9.]+)\"[^>]*>([-0-9.]+)</text>");
  for (std::sregex_iterator it(svg.begin(), svg.end(), pattern), end; it != end; ++it)
    found.push_back({std::stod((*it)[1]), std::stod((*it)[2])});
  return found;
}

double value_at(const std::vector<Tick>& ticks, double at) {
  const Tick a = ticks.front(), b = ticks.back();
  return a.value + (at - a.at) / (b.at - a.at) * (b.value - a.value);
}

std::vector<std::array<double, 2>> line_points(const std::string& svg) {
  std::vector<std::array<double, 2>> points;
  std::smatch line;
  EXPECT_TRUE(std::regex_search(svg, line, std::regex("<polyline points=\"([^\"]*)\"/>")));
  const std::string text = line[1];
  const std::regex pair("([-0-9.]+),([-0-9.]+)");
  for (std::sregex_iterator it(text.begin(), text.end(), pair), end; it != end; ++it)
    points.push_back({std::stod((*it)[1]), std::stod((*it)[2])});
  return points;
}

TEST(PressCurve, ItsPointsAreTheFramesReadAgainstTheTicks) {
  const std::vector<FrameReport> frames{{.depth_m = -5.1e-5, .press_force_n = 0.0},
                                        {.depth_m = 1.5e-4, .press_force_n = 0.0653},
                                        {.depth_m = 4.5e-4, .press_force_n = 0.3903}};
  const std::string svg = press_curve_svg(frames);
  const auto depth = ticks(svg, "x-tick", "x"), force = ticks(svg, "y-tick", "y");
  ASSERT_GE(depth.size(), 3u);
  ASSERT_GE(force.size(), 3u);
  const auto points = line_points(svg);
  ASSERT_EQ(points.size(), frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_NEAR(value_at(depth, points[i][0]), 1e3 * frames[i].depth_m, 2e-5);
    // The labels stand 4 below their line, all alike, as texts are set on their baseline.
    EXPECT_NEAR(value_at(force, points[i][1] + 4), frames[i].press_force_n, 2e-5);
  }
  EXPECT_NE(svg.find("indentation depth (mm)"), std::string::npos);
  EXPECT_NE(svg.find("press force (N)"), std::string::npos);
  EXPECT_NE(svg.find("<title>frame 2: 0.450 mm, 0.390 N, 0 Newton iterations</title>"), std::string::npos);
}

TEST(PressCurve, TicksAreEvenAndTheirLabelsExact) {
  const std::string svg = press_curve_svg({{.depth_m = -5e-5}, {.depth_m = 5e-4, .press_force_n = 12.0}});
  for (const auto& axis : {ticks(svg, "x-tick", "x"), ticks(svg, "y-tick", "y")}) {
    for (std::size_t i = 0; i < axis.size(); ++i) EXPECT_NEAR(axis[i].value, value_at(axis, axis[i].at), 1e-3);
  }
  EXPECT_EQ(svg.find("-0.0<"), std::string::npos);
}

TEST(PressCurve, OneFrameWithoutForceIsDrawn) {
  const std::string svg = press_curve_svg({{.depth_m = 0.0, .press_force_n = 0.0}});
  EXPECT_EQ(line_points(svg).size(), 1u);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

}  // namespace
}  // namespace tacipc
