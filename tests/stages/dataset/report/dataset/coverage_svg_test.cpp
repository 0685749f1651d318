#include "stages/dataset/report/dataset/coverage_svg.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/stages/dataset/report/svg_numbers.h"

namespace tacipc {
namespace coverage_svg_test {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(HistogramSvg, BarsAreAsHighAsTheirCountsAndStandOnEachOther) {
  const Histogram h = histogram({{0, 0, 0, 0, 1}, {0, 0}}, 2);
  const std::string svg = histogram_svg(h, {"train", "<test>"}, "depth", "depth (mm)");
  const auto heights = numbers(svg, "<rect[^>]* height=\"([0-9.]+)\"");
  const auto tops = numbers(svg, "<rect[^>]* y=\"([0-9.]+)\"");
  ASSERT_EQ(heights.size(), 3u);  // an empty bar is not drawn
  EXPECT_NEAR(heights[0], 4 * heights[1], 0.02);
  EXPECT_NEAR(heights[2], 2 * heights[1], 0.02);
  EXPECT_NEAR(tops[2] + heights[2], tops[0], 0.02);
  EXPECT_THAT(svg, HasSubstr("2 &lt;test&gt;"));
  EXPECT_THAT(svg, HasSubstr("aria-label=\"depth\""));
}

TEST(HistogramSvg, CountsHaveWholeTicks) {
  const std::string svg = histogram_svg(histogram({{1, 2}}, 4), {"train"}, "what", "x");
  for (const double tick : numbers(svg, "class=\"y-tick\"[^>]*>([-0-9.]+)<")) EXPECT_EQ(tick, std::round(tick));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

TEST(PairMapSvg, DrawsTheCellsThatHaveSamples) {
  const std::string svg = pair_map_svg(pair_map({0, 1, 1}, {0, 2, 2}, 10, 10, 7), "what", "x", "y");
  const auto opacities = numbers(svg, "opacity=\"([0-9.]+)\"");
  ASSERT_EQ(opacities.size(), 2u);
  EXPECT_LT(opacities[0], opacities[1]);
  EXPECT_EQ(opacities[1], 1.0);
}

TEST(SpreadsSvg, ShowsEachRowWithItsMedianInside) {
  const std::string svg =
      spreads_svg({{"a & b", *spread_of({1, 2, 3})}, {"a name of many letters", *spread_of({5})}}, "what", "x");
  EXPECT_THAT(svg, HasSubstr("a &amp; b"));
  EXPECT_THAT(svg, HasSubstr(">a name of many…<title>a name of many letters</title>"));
  const auto from = numbers(svg, "<rect x=\"([0-9.]+)\""), width = numbers(svg, "<rect[^>]* width=\"([0-9.]+)\"");
  const auto medians = numbers(svg, "class=\"median\" d=\"M([0-9.]+)");
  ASSERT_EQ(from.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_GE(medians[i], from[i]);
    EXPECT_LE(medians[i], from[i] + width[i]);
  }
}

}  // namespace coverage_svg_test
}  // namespace tacipc
