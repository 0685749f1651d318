#include "stages/dataset/report/press_curve.h"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <regex>

#include "tests/scratch_folder.h"
#include "tests/stages/dataset/report/sheared_folder.h"

namespace tacipc {
namespace press_curve_test {

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
    EXPECT_NEAR(value_at(depth, points[i][0]), 1e3 * frames[i].depth_m.value(), 2e-5);
    // The labels stand 4 below their line, all alike, as texts are set on their baseline.
    EXPECT_NEAR(value_at(force, points[i][1] + 4), frames[i].press_force_n, 2e-5);
  }
  EXPECT_NE(svg.find("indentation depth (mm)"), std::string::npos);
  EXPECT_NE(svg.find("press force (N)"), std::string::npos);
  EXPECT_NE(svg.find("<title>frame 2: 0.450 mm, 0.390 N, 0 Newton iterations</title>"), std::string::npos);
}

TEST(PressCurve, ManyFramesAreALineWithoutMarks) {
  std::vector<FrameReport> frames(300);
  for (std::size_t i = 0; i < frames.size(); ++i) frames[i].depth_m = 1e-6 * static_cast<double>(i);
  const std::string svg = press_curve_svg(frames);
  EXPECT_EQ(line_points(svg).size(), 300u);
  EXPECT_EQ(svg.find("<circle"), std::string::npos);
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

class FrameCurvesTest : public ::testing::Test {
 protected:
  ScratchFolder scratch_;
  SampleReport sample_ = read_sample(write_sheared_sample(scratch_ / ""));
};

using ::testing::HasSubstr;
using ::testing::Not;

TEST_F(FrameCurvesTest, ShowForcesContactRatioAndBalance) {
  const std::string html = frame_curves(sample_);
  EXPECT_THAT(html, HasSubstr("aria-label=\"forces over frames\""));
  EXPECT_THAT(html, HasSubstr("<title>frame 4: 1.20 N into the gel</title>"));
  EXPECT_THAT(html, HasSubstr("<title>frame 4: 0.840 N along the face</title>"));
  EXPECT_THAT(html, HasSubstr("<title>frame 3: 5.00 mm²</title>"));
  EXPECT_THAT(html, HasSubstr("<title>frame 3: 244 kPa</title>"));
  EXPECT_THAT(html, HasSubstr(">friction coefficient 0.7</text>"));
  EXPECT_THAT(html, HasSubstr("<title>frame 2: 2.00e-04 of the contact force</title>"));
  EXPECT_THAT(html, HasSubstr("at most 2.50e-04 N (frame 2)"));
  EXPECT_THAT(html, HasSubstr(">limit</text>"));
  EXPECT_THAT(html, HasSubstr("<br>Frames: reference 0, approach 1, press 2, shear 3–4"));
}

TEST_F(FrameCurvesTest, TheTorqueIsDrawnWhereTheObjectTurns) {
  EXPECT_THAT(frame_curves(sample_), Not(HasSubstr("torque")));  // a shear
  sample_.phases.back().name = "twist";
  const std::string html = frame_curves(sample_);
  EXPECT_THAT(html, HasSubstr("torque about z (N mm)"));
  EXPECT_THAT(html, HasSubstr("<title>frame 3: 3.00 N mm about z</title>"));
  EXPECT_THAT(html, HasSubstr("<i class=\"key color-3\"></i>torque"));
}

TEST_F(FrameCurvesTest, TheRatioIsLeftOutWhereNothingPresses) {
  sample_.frames = {{.press_force_n = 0.0, .tangential_force_n = 0.0},
                    {.press_force_n = 2.0, .tangential_force_n = 1.0},
                    {.press_force_n = 0.01, .tangential_force_n = 1.0}};  // half a percent of the largest
  const std::string html = frame_curves(sample_);
  EXPECT_THAT(html, HasSubstr("<title>frame 1: 0.500 </title>"));
  EXPECT_THAT(html, Not(HasSubstr("<title>frame 2: 100 </title>")));
}

TEST_F(FrameCurvesTest, TheBalancesLimitIsTheRecords) {
  const auto level = [&](std::optional<double> limit) {
    sample_.balance_limit = limit;
    const std::string html = frame_curves(sample_);
    std::smatch found;
    return std::regex_search(html, found, std::regex("y=\"([0-9.]+)\"[^>]*>limit</text>")) ? std::stod(found[1]) : -1.0;
  };
  EXPECT_GT(level(1e-4), level(1e-3)) << "y points down";
  EXPECT_GT(level(1e-3), 0.0);
  EXPECT_EQ(level(std::nullopt), -1.0);
}

TEST_F(FrameCurvesTest, SlipIsMarkedAtItsTime) {
  const std::string html = frame_curves(sample_);
  std::smatch first, gross;
  ASSERT_TRUE(std::regex_search(html, first, std::regex("d=\"M([0-9.]+) [0-9.]+V[0-9.]+\"/>[^>]*>first slip")));
  ASSERT_TRUE(std::regex_search(html, gross, std::regex("d=\"M([0-9.]+) [0-9.]+V[0-9.]+\"/>[^>]*>gross slip")));
  const auto frames = ticks(html.substr(0, html.find("</svg>")), "x-tick", "x");
  EXPECT_NEAR(value_at(frames, std::stod(first[1])), 2.5, 0.01);  // 0.025 s lies halfway between frames 2 and 3
  EXPECT_NEAR(value_at(frames, std::stod(gross[1])), 4.0, 0.01);
}

TEST_F(FrameCurvesTest, AnOlderRecordHasItsPressForceOnly) {
  const SampleReport plain = read_sample(write_sample(scratch_ / "plain"));
  const std::string html = frame_curves(plain);
  EXPECT_THAT(html, HasSubstr("forces over frames"));
  for (const char* absent : {"tangential", "contact area", "balance", "friction", "slip"})
    EXPECT_THAT(html, Not(HasSubstr(absent)));
}

}  // namespace press_curve_test
}  // namespace tacipc
