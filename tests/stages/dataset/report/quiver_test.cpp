#include "stages/dataset/report/quiver.h"

#include <fmt/core.h>
#include <gmock/gmock.h>

#include <regex>

namespace tacipc {
namespace quiver_test {

using ::testing::HasSubstr;
using ::testing::Not;

/// A grid 1 mm apart whose markers all move by the same.
MarkerPicture grid(double dx_mm, double dy_mm, int side = 5) {
  MarkerPicture picture{.frame = 7, .since_press = false, .arrows = {}, .contacts = {}};
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) picture.arrows.push_back({1.0 * x, 1.0 * y, dx_mm, dy_mm});
  }
  return picture;
}

TEST(ArrowScale, IsRoundAndMakesTheLongestReachTowardsTheNextMarker) {
  for (const double length : {1e-5, 3e-4, 0.02, 0.3, 0.9, 1.2, 7.0}) {
    const double scale = arrow_scale(grid(0.6 * length, 0.8 * length).arrows);
    EXPECT_LE(scale * length, 1 + 1e-9) << length;
    EXPECT_GT(scale * length, 0.399) << length;
    const std::string digits = fmt::format("{:.3e}", scale);
    EXPECT_THAT(digits.substr(0, 5), ::testing::AnyOf("1.000", "2.000", "5.000")) << scale;
  }
}

TEST(ArrowScale, WithoutMovementOrNeighboursItIsOne) {
  EXPECT_EQ(arrow_scale(grid(0, 0).arrows), 1.0);
  EXPECT_EQ(arrow_scale({{0, 0, 0.3, 0}}), 1.0);
  EXPECT_EQ(arrow_scale({}), 1.0);
}

TEST(Quiver, ArrowsPointRightAndDownAsTheImageDoes) {
  MarkerPicture picture = grid(0.2, 0.1, 2);
  const std::string svg = quiver_svg(picture, view_of({picture}));
  std::smatch arrow;
  ASSERT_TRUE(
      std::regex_search(svg, arrow, std::regex("class=\"arrows\" d=\"M([0-9.]+) ([0-9.]+)l([-0-9.]+) ([-0-9.]+)m")));
  const double dx = std::stod(arrow[3]), dy = std::stod(arrow[4]);
  EXPECT_GT(dx, 0);
  EXPECT_NEAR(dy, dx / 2, 0.06);
}

TEST(Quiver, TheKnownArrowIsDrawnAsLongAsItsWordsSay) {
  MarkerPicture picture = grid(0.34, 0.0);
  const View view = view_of({picture});
  const std::string svg = quiver_svg(picture, view);
  EXPECT_THAT(svg, HasSubstr(">0.2 mm (drawn × 2)</text>"));
  const std::regex pattern("class=\"arrows\" d=\"M[0-9.]+ [0-9.]+l([-0-9.]+) 0.0m");
  std::vector<double> lengths;  // of the first marker's arrow and of the known one
  for (std::sregex_iterator it(svg.begin(), svg.end(), pattern), end; it != end; ++it)
    lengths.push_back(std::stod((*it)[1]));
  ASSERT_EQ(lengths.size(), 2u);
  EXPECT_NEAR(lengths[1] / lengths[0], 0.2 / 0.34, 0.005);
  const double per_mm = 384 / (view.high_x - view.low_x);
  EXPECT_NEAR(lengths[1], 2 * 0.2 * per_mm, 0.06);
}

TEST(Quiver, MarkersAtRestAreDotsAndSaySo) {
  const MarkerPicture picture = grid(0, 1e-8);
  const std::string svg = quiver_svg(picture, view_of({picture}));
  EXPECT_THAT(svg, HasSubstr("class=\"dots\""));
  EXPECT_THAT(svg, Not(HasSubstr("class=\"arrows\"")));
  EXPECT_THAT(svg, HasSubstr("no marker moved by a nanometre"));
}

TEST(Quiver, ContactsLieUnderTheArrowsAndSlipShows) {
  MarkerPicture picture = grid(0.1, 0);
  picture.contacts = {{1, 1, false}, {2, 2, true}, {2.0001, 2, false}};  // the last two share a dot
  const std::string svg = quiver_svg(picture, view_of({picture}));
  EXPECT_LT(svg.find("class=\"stuck\""), svg.find("class=\"slipping\""));
  EXPECT_LT(svg.find("class=\"slipping\""), svg.find("class=\"arrows\""));
  const auto dots = [&](const std::string& kind) {
    const auto from = svg.find("class=\"" + kind + "\" d=\"");
    const std::string path = svg.substr(from, svg.find("/>", from) - from);
    return std::count(path.begin(), path.end(), 'M');
  };
  EXPECT_EQ(dots("stuck"), 1);
  EXPECT_EQ(dots("slipping"), 1);
}

TEST(Quiver, AFineGelMakesNoLargerPicture) {
  MarkerPicture picture{.frame = 1, .since_press = false, .arrows = {}, .contacts = {}};
  for (int y = 0; y < 400; ++y) {
    for (int x = 0; x < 400; ++x) picture.contacts.push_back({0.025 * x, 0.025 * y, x > 200});
  }
  EXPECT_LT(quiver_svg(picture, view_of({picture})).size(), 250'000u);
}

TEST(View, HoldsEveryMarkerOfAllPicturesAndAMargin) {
  MarkerPicture a = grid(0, 0, 3), b = grid(0, 0, 2);
  b.contacts = {{-4, 9, true}};
  const View view = view_of({a, b});
  EXPECT_LT(view.low_x, -4);
  EXPECT_GT(view.high_x, 2);
  EXPECT_LT(view.low_y, 0);
  EXPECT_GT(view.high_y, 9);
}

}  // namespace quiver_test
}  // namespace tacipc
