#include "common/image/plot.h"

#include <gtest/gtest.h>

namespace tacipc {
namespace plot_test {

TEST(Plot, WritesWhatItShows) {
  const std::string svg = to_svg(Plot{.title = "a < b",
                                      .x_label = "x",
                                      .y_label = "y",
                                      .curves = {{"one", {{0, 0}, {1, 2}}}, {"two", {{0.5, 1}}, true}}});
  EXPECT_NE(svg.find("a &lt; b"), std::string::npos);
  EXPECT_NE(svg.find("<circle"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(Plot, AnAxisMayBeginAtItsLeastValue) {
  Plot plot{.title = "", .x_label = "", .y_label = "", .curves = {{"one", {{40, 1}, {50, 2}}}}};
  EXPECT_NE(to_svg(plot).find(">0</text>"), std::string::npos);
  EXPECT_NE(to_svg(plot).find(">20</text>"), std::string::npos);
  plot.zero_in_x = false;
  EXPECT_EQ(to_svg(plot).find(">20</text>"), std::string::npos);
  EXPECT_NE(to_svg(plot).find(">45</text>"), std::string::npos);
}

TEST(Plot, LogarithmicAxesHaveTheNumbersThemselvesAndLeaveZeroOut) {
  const std::string svg = to_svg(Plot{.title = "",
                                      .x_label = "",
                                      .y_label = "",
                                      .curves = {{"one", {{0.0, 1.0}, {1.0, 100.0}, {10.0, 1000.0}}, true}},
                                      .logarithmic = true});
  EXPECT_EQ(svg.find("inf"), std::string::npos);
  EXPECT_NE(svg.find(">5</text>"), std::string::npos) << svg;
  EXPECT_NE(svg.find(">500</text>"), std::string::npos);
  std::size_t circles = 0;
  for (std::size_t at = svg.find("<circle"); at != std::string::npos; at = svg.find("<circle", at + 1)) ++circles;
  EXPECT_EQ(circles, 2u);
}

}  // namespace plot_test
}  // namespace tacipc
