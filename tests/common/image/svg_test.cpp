#include "common/image/svg.h"

#include <gtest/gtest.h>

namespace tacipc {
namespace svg_test {

const AxesLook kLook{.grid = "class=\"grid\"", .axis = "", .x_tick = "", .y_tick = "class=\"y\"", .decimals = 1};
constexpr PlotArea kArea{.left = 60.0, .right = 160.0, .top = 10.0, .bottom = 90.0};

TEST(Svg, TicksLieAtTheirValuesWithLabelsBeside) {
  const Scale x{round_axis(0.0, 4.0, 3), kArea.left, kArea.right}, y{round_axis(0.0, 4.0, 3), kArea.bottom, kArea.top};
  EXPECT_EQ(
      x_ticks_svg(ticks_of(x), kArea, kLook),
      "<path d=\"M60.0 10.0V90.0\" class=\"grid\"/><text x=\"60.0\" y=\"108.0\" text-anchor=\"middle\">0</text>\n"
      "<path d=\"M110.0 10.0V90.0\" class=\"grid\"/><text x=\"110.0\" y=\"108.0\" text-anchor=\"middle\">2</text>\n"
      "<path d=\"M160.0 10.0V90.0\" class=\"grid\"/><text x=\"160.0\" y=\"108.0\" text-anchor=\"middle\">4</text>\n");
  EXPECT_EQ(y_ticks_svg({ticks_of(y)[1]}, kArea, kLook),
            "<path d=\"M60.0 50.0H160.0\" class=\"grid\"/><text class=\"y\" x=\"52.0\" y=\"54.0\" "
            "text-anchor=\"end\">2</text>\n");
  EXPECT_EQ(axes_svg(kArea, kLook), "<path d=\"M60.0 10.0V90.0H160.0\"/>\n");
}

TEST(Svg, ArrowsEndInAHeadThatLooksBack) {
  const Eigen::Vector2d from(10, 20), by(30, 0);
  // The shaft, one side of the head and back to the tip, the other side.
  EXPECT_EQ(arrows_svg(from, by, "class=\"a\""),
            "<path class=\"a\" d=\"M10.0 20.0l30.0 0.0m-5.0 2.5l5.0 -2.5l-5.0 -2.5\"/>\n");
}

TEST(Svg, QuiversAreOnePathOfWhatCanBeSeen) {
  Eigen::Matrix2Xd from(2, 3), by(2, 3);
  from << 0, 10, 20, 0, 0, 0;
  by << 4, 0.1, 0, 0, 0.1, -4;
  const std::string svg = arrows_svg(from, by, "");
  EXPECT_EQ(std::count(svg.begin(), svg.end(), 'M'), 2);
  EXPECT_EQ(dots_svg(from, "stroke-width=\"2\""),
            "<path stroke-width=\"2\" d=\"M0.0 0.0h0M10.0 0.0h0M20.0 0.0h0\"/>\n");
  EXPECT_EQ(arrows_svg(from, Eigen::Matrix2Xd::Zero(2, 3), ""), "");
  EXPECT_EQ(dots_svg(Eigen::Matrix2Xd(2, 0), ""), "");
}

}  // namespace svg_test
}  // namespace tacipc
