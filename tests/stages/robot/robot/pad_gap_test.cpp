#include "stages/robot/robot/pad_gap.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/make_mesh.h"

namespace tacipc {
namespace pad_gap_test {

Matrix4 moved(const Vector3& by_m, double turn_rad = 0.0, const Vector3& axis = Vector3::UnitX()) {
  Matrix4 pose = Matrix4::Identity();
  pose.topLeftCorner<3, 3>() = Eigen::AngleAxisd(turn_rad, axis).toRotationMatrix();
  pose.topRightCorner<3, 1>() = by_m;
  return pose;
}

const TriangleMesh kBox = make_box({-0.02, -0.02, 0.0}, {0.02, 0.02, 0.01});

TEST(GapBefore, IsTheNearestFaceOfABox) {
  EXPECT_DOUBLE_EQ(gap_before(kBox, moved({0, 0, 0.003}), 0.005), 0.003);
  EXPECT_DOUBLE_EQ(gap_before(kBox, moved({0, 0, -0.0004}), 0.005), -0.0004);
}

TEST(GapBefore, IsBoundlessWhereNothingIsInFront) {
  EXPECT_EQ(gap_before(kBox, moved({0.0251, 0, 0.003}), 0.005), std::numeric_limits<double>::infinity());
  EXPECT_EQ(gap_before(kBox, moved({0, -0.0251, 0.003}), 0.005), std::numeric_limits<double>::infinity());
  // Its edge is still there.
  EXPECT_DOUBLE_EQ(gap_before(kBox, moved({0.0249, 0, 0.003}), 0.005), 0.003);
}

TEST(GapBefore, OfATiltedFaceIsWhereItCrossesTheEdge) {
  const double angle = 0.1;
  // The lower face through the origin, z = y tan φ, ends at |y| = 5 mm before the gel, not at the corner of the box.
  EXPECT_NEAR(gap_before(kBox, moved({0, 0, 0.002}, angle), 0.005), 0.002 - 0.005 * std::tan(angle), 1e-15);
  EXPECT_NEAR(gap_before(kBox, moved({0, 0, 0.002}, -angle), 0.005), 0.002 - 0.005 * std::tan(angle), 1e-15);
  EXPECT_NEAR(gap_before(kBox, moved({0, 0, 0.002}, angle, Vector3::UnitY()), 0.005), 0.002 - 0.005 * std::tan(angle),
              1e-15);
}

TEST(GapBefore, SeesATriangleWithoutACornerInFrontOfTheGel) {
  const TriangleMesh large = make_mesh({{-1, -1, 0.001}, {2, -1, 0.001}, {-1, 2, 0.001}}, {{0, 2, 1}});
  EXPECT_NEAR(gap_before(large, Matrix4::Identity(), 0.005), 0.001, 1e-15);
}

TEST(GapBefore, IsNotThatOfAFloorBesideTheGelOrOfWhatIsBehindIt) {
  // The gel looks along the floor, 3 mm above it: of what is in front of it the floor is the side.
  const TriangleMesh floor = make_box({-0.1, -0.02, -0.1}, {0.1, -0.003, 0.1});
  EXPECT_EQ(gap_before(floor, Matrix4::Identity(), 0.005), std::numeric_limits<double>::infinity());
  // Not quite along it.
  EXPECT_EQ(gap_before(floor, moved({0, 0, 0}, 0.1), 0.005), std::numeric_limits<double>::infinity());
  EXPECT_EQ(gap_before(kBox, moved({0, 0, -0.1}), 0.005), std::numeric_limits<double>::infinity());
}

TEST(GapBefore, OfABallIsItsLowestPoint) {
  const double radius = 0.01;
  EXPECT_NEAR(gap_before(sphere(radius, 5), moved({0, 0, 0.012}), 0.005), 0.002, 1e-9);
  // Beside it the ball rises: z = c − √(R² − y²) at the edge of what is looked at, within the facets' error.
  const double edge = 0.008 - 0.005;
  EXPECT_NEAR(gap_before(sphere(radius, 5), moved({0, 0.008, 0.012}), 0.005),
              0.012 - std::sqrt(radius * radius - edge * edge), 5e-6);
}

}  // namespace pad_gap_test
}  // namespace tacipc
