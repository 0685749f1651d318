#include "stages/dataset/report/chart.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/stages/dataset/report/svg_numbers.h"

namespace tacipc {
namespace chart_test {

using ::testing::HasSubstr;
using ::testing::Not;

Chart chart_of(std::vector<std::optional<double>> values) {
  Chart chart{.what = "values", .x_label = "frame", .left_label = "value (N)"};
  for (std::size_t i = 0; i < values.size(); ++i) chart.x.push_back(static_cast<double>(i));
  chart.left.push_back({std::move(values)});
  return chart;
}

int count(const std::string& text, const std::string& part) {
  int found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(Chart, AMissingValueBreaksTheLine) {
  const std::string svg = chart_svg(chart_of({1.0, 2.0, std::nullopt, 3.0, 4.0}));
  EXPECT_EQ(count(svg, "<polyline"), 2);
  EXPECT_EQ(count(chart_svg(chart_of({std::nullopt, std::nullopt})), "<polyline"), 0);
}

TEST(Chart, ACurveUnderOthersIsBroad) {
  Chart chart = chart_of({1.0, 2.0});
  chart.left[0].broad = true;
  chart.left.push_back({{1.0, 2.0}});
  const std::string svg = chart_svg(chart);
  EXPECT_LT(svg.find("<g class=\"color-1 broad\">"), svg.find("<g class=\"color-2\">"));
  EXPECT_EQ(curve_key(1, true), "<i class=\"key color-1 broad\"></i>");
}

TEST(Chart, FramesAreCountedInWholeNumbersToTheLast) {
  for (const std::size_t frames : {1u, 2u, 3u, 23u, 306u}) {
    Chart chart = chart_of(std::vector<std::optional<double>>(frames, 1.0));
    chart.whole_x = true;
    const std::string svg = chart_svg(chart);
    SCOPED_TRACE(frames);
    for (const double tick : numbers(svg, "<text class=\"x-tick\"[^>]*>([-0-9.]+)<")) {
      EXPECT_EQ(tick, std::round(tick));
      EXPECT_LE(tick, std::max<double>(1, static_cast<double>(frames) - 1));
    }
    EXPECT_THAT(svg, Not(HasSubstr("nan")));
    // The last frame lies at the right end.
    if (frames > 1) {
      EXPECT_THAT(svg, HasSubstr(" 378.00,"));
    }
  }
}

TEST(Chart, TheSecondScaleHasItsOwnTicks) {
  Chart chart = chart_of({0.0, 1.0});
  chart.right_label = "pressure (kPa)";
  chart.right.push_back({{0.0, 250.0}});
  const std::string svg = chart_svg(chart);
  EXPECT_THAT(svg, HasSubstr("pressure (kPa)"));
  EXPECT_THAT(numbers(svg, "<text class=\"right-tick\"[^>]*>([-0-9.]+)<"),
              ::testing::ElementsAre(0, 50, 100, 150, 200, 250));
  EXPECT_THAT(numbers(svg, "<text class=\"y-tick\"[^>]*>([-0-9.]+)<"),
              ::testing::ElementsAre(0, 0.2, 0.4, 0.6, 0.8, 1.0));
  // Both end at the top.
  const auto ends = numbers(svg, "338\\.00,([0-9.]+)\"/>");
  ASSERT_EQ(ends.size(), 2u);
  EXPECT_EQ(ends[0], ends[1]);
  EXPECT_THAT(svg, HasSubstr("<g class=\"color-2\">"));
}

TEST(Chart, DecadesAreEvenlySpacedAndZeroIsLeftOut) {
  Chart chart = chart_of({0.0, 1e-6, 1e-5, 1e-4});
  chart.logarithmic = true;
  chart.limit = Rule{"limit", 1e-3};
  const std::string svg = chart_svg(chart);
  std::smatch line;
  ASSERT_TRUE(std::regex_search(
      svg, line, std::regex("<polyline points=\"[0-9.]+,([0-9.]+) [0-9.]+,([0-9.]+) [0-9.]+,([0-9.]+)\"")));
  const double a = std::stod(line[1]), b = std::stod(line[2]), c = std::stod(line[3]);
  EXPECT_NEAR(a - b, b - c, 0.02);
  EXPECT_GT(b - c, 10);
  std::smatch rule;
  ASSERT_TRUE(std::regex_search(svg, rule, std::regex("class=\"rule\" d=\"M[0-9.]+ ([0-9.]+)H")));
  EXPECT_NEAR(std::stod(rule[1]), c - (b - c), 0.02);
  for (const char* tick : {">1e-6<", ">1e-5<", ">1e-4<", ">1e-3<"}) EXPECT_THAT(svg, HasSubstr(tick));
}

TEST(Chart, AllZeroOnALogarithmicScaleIsAnEmptyDrawing) {
  Chart chart = chart_of({0.0, 0.0});
  chart.logarithmic = true;
  const std::string svg = chart_svg(chart);
  EXPECT_EQ(count(svg, "<polyline"), 0);
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
}

TEST(Chart, BandsAreNamedAlongUprightOrWhenPointedAt) {
  Chart chart = chart_of(std::vector<std::optional<double>>(101, 1.0));
  chart.bands = {{"wide", 10, 60}, {"upright", 60, 66}, {"hidden", 66, 67}};
  const std::string svg = chart_svg(chart);
  EXPECT_EQ(count(svg, "<rect class=\"band"), 3);
  for (const char* name : {"wide", "upright", "hidden"})
    EXPECT_THAT(svg, HasSubstr(std::string("<title>") + name + "</title>"));
  EXPECT_THAT(svg, ::testing::ContainsRegex("<text class=\"band-name\" x=[^>]*>wide<"));
  EXPECT_THAT(svg, ::testing::ContainsRegex("<text class=\"band-name\" transform=[^>]*>upright<"));
  EXPECT_THAT(svg, Not(HasSubstr(">hidden</text>")));
}

TEST(Chart, NamesCannotBecomeMarkup) {
  Chart chart = chart_of({1.0, 2.0});
  chart.bands = {{"<b>", 0, 1}};
  chart.places = {{"<i>", 1}};
  chart.limit = Rule{"<u>", 1};
  const std::string svg = chart_svg(chart);
  for (const char* tag : {"<b>", "<i>", "<u>"}) EXPECT_THAT(svg, Not(HasSubstr(tag)));
}

}  // namespace chart_test
}  // namespace tacipc
