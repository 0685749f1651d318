#include "stages/object/emboss/outline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/base/rng.h"

namespace tacipc {
namespace outline_test {

using std::numbers::pi;

Vector2 random_point(std::uint64_t i, double half) {
  return half * Vector2(2 * random_uniform(7, 0, 2 * i) - 1, 2 * random_uniform(7, 0, 2 * i + 1) - 1);
}

TEST(SegmentDistance, EndsMiddleAndPoint) {
  EXPECT_DOUBLE_EQ(segment_distance({1, 2}, {0, 0}, {2, 0}), 2.0);
  EXPECT_DOUBLE_EQ(segment_distance({5, 4}, {0, 0}, {2, 0}), 5.0);
  EXPECT_DOUBLE_EQ(segment_distance({3, 4}, {0, 0}, {0, 0}), 5.0);
}

TEST(PolygonDistance, SquareInsideOutsideAndBothOrientations) {
  Points2 square{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  for (int turn = 0; turn < 2; ++turn) {
    EXPECT_DOUBLE_EQ(polygon_distance(square, {0, 0}), 1.0);
    EXPECT_DOUBLE_EQ(polygon_distance(square, {0.75, 0.5}), 0.25);
    EXPECT_DOUBLE_EQ(polygon_distance(square, {4, 5}), -5.0);
    EXPECT_DOUBLE_EQ(polygon_distance(square, {0, -1.5}), -0.5);
    std::reverse(square.begin(), square.end());
  }
}

TEST(PolygonDistance, RayThroughCornersKeepsTheSign) {
  const Points2 diamond{{0, 1}, {-1, 0}, {0, -1}, {1, 0}};
  EXPECT_GT(polygon_distance(diamond, {-0.5, 0.0}), 0.0);
  EXPECT_LT(polygon_distance(diamond, {-1.5, 0.0}), 0.0);
  EXPECT_LT(polygon_distance(diamond, {-0.5, 1.0}), 0.0);
}

TEST(RegularPolygon, FirstCornerIsUpAndTheInscribedRadiusIsRight) {
  const Points2 hexagon = regular_polygon(6, 2.0, 0.0);
  ASSERT_EQ(hexagon.size(), 6u);
  EXPECT_NEAR(hexagon[0].x(), 0.0, 1e-15);
  EXPECT_NEAR(hexagon[0].y(), 2.0, 1e-15);
  EXPECT_LT(hexagon[1].x(), 0.0);  // counter-clockwise
  EXPECT_NEAR(polygon_distance(hexagon, {0, 0}), std::sqrt(3.0), 1e-14);
}

TEST(StarPolygon, TipsOutNotchesIn) {
  const Points2 star = star_polygon(5, 2.0, 1.0);
  ASSERT_EQ(star.size(), 10u);
  EXPECT_GT(polygon_distance(star, {0, 1.9}), 0.0);
  EXPECT_LT(polygon_distance(star, {0, -1.1}), 0.0);  // below lies a notch
  EXPECT_GT(polygon_distance(star, {0, -0.9}), 0.0);
}

TEST(GearPolygon, ToothAndGap) {
  const Points2 gear = gear_polygon(8, 3.0, 4.0, 0.3);
  const double half_pitch = pi / 8;
  EXPECT_GT(polygon_distance(gear, {0, 3.9}), 0.0);
  EXPECT_LT(polygon_distance(gear, 3.5 * Vector2(std::sin(half_pitch), std::cos(half_pitch))), 0.0);
  EXPECT_GT(polygon_distance(gear, 2.9 * Vector2(std::sin(half_pitch), std::cos(half_pitch))), 0.0);
}

TEST(BarsDistance, PeriodAndSign) {
  EXPECT_DOUBLE_EQ(bars_distance(0.0, 1.0, 0.5), 0.25);
  EXPECT_DOUBLE_EQ(bars_distance(0.5, 1.0, 0.5), -0.25);
  EXPECT_NEAR(bars_distance(-3.1, 1.0, 0.5), 0.15, 1e-14);
}

TEST(CheckerDistance, NeighboursDifferInSign) {
  EXPECT_DOUBLE_EQ(checker_distance({0, 0}, 2.0), 1.0);
  EXPECT_DOUBLE_EQ(checker_distance({2, 0}, 2.0), -1.0);
  EXPECT_DOUBLE_EQ(checker_distance({-2, -2.5}, 2.0), 0.5);
}

TEST(BricksDistance, JointsAndShiftedRows) {
  EXPECT_DOUBLE_EQ(bricks_distance({0, 0}, 4, 2, 0.5), 0.75);
  EXPECT_DOUBLE_EQ(bricks_distance({2, 0}, 4, 2, 0.5), -0.25);
  EXPECT_DOUBLE_EQ(bricks_distance({2, 2}, 4, 2, 0.5), 0.75);
  EXPECT_NEAR(bricks_distance({2, 1}, 4, 2, 0.5), -0.25, 1e-15);
  EXPECT_NEAR(bricks_distance({2.05, 0.95}, 4, 2, 0.5), -std::hypot(0.2, 0.2), 1e-15);
}

TEST(HexagonalLattice, NearestPointMatchesSearchAndBorderIsHalfwayToTheSecond) {
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const Vector2 p = random_point(i, 4.0);
    double least = 1e9, border = 1e9;
    Vector2 best = Vector2::Zero();
    const auto lattice = [](int a, int b) -> Vector2 { return 1.3 * Vector2(a + 0.5 * b, 0.5 * std::sqrt(3.0) * b); };
    for (int a = -9; a <= 9; ++a)
      for (int b = -9; b <= 9; ++b)
        if (const double d = (p - lattice(a, b)).norm(); d < least) least = d, best = lattice(a, b);
    for (int a = -9; a <= 9; ++a)
      for (int b = -9; b <= 9; ++b)
        if (const Vector2 to = lattice(a, b) - best; to.norm() > 0.1)
          border = std::min(border, (best + to / 2 - p).dot(to.normalized()));
    EXPECT_NEAR((nearest_hexagonal(p, 1.3) - best).norm(), 0.0, 1e-12) << p.transpose();
    EXPECT_NEAR(hexagon_border_distance(p, 1.3), border, 1e-12) << p.transpose();
  }
}

TEST(CellBorderDistance, IsADistanceThatVanishesOnlyOnBorders) {
  double least = 1e9, most = 0.0;
  for (std::uint64_t i = 0; i < 4000; ++i) {
    const Vector2 p = random_point(i, 6.0), q = p + 0.01 * random_point(i + 10000, 1.0);
    const double a = cell_border_distance(p, 1.5, 3), b = cell_border_distance(q, 1.5, 3);
    EXPECT_GE(a, -1e-12);
    // A distance changes no faster than its point moves, across borders too.
    EXPECT_LE(std::abs(a - b), (p - q).norm() + 1e-12) << p.transpose();
    least = std::min(least, a);
    most = std::max(most, a);
  }
  EXPECT_LT(least, 0.01);
  EXPECT_GT(most, 0.3);
  EXPECT_NE(cell_border_distance({0.2, 0.3}, 1.5, 3), cell_border_distance({0.2, 0.3}, 1.5, 4));
}

}  // namespace outline_test
}  // namespace tacipc
