#include "stages/rival/baseline/marker_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/config/config.h"

namespace tacipc {
namespace marker_motion_test {

FotsMotion published() {
  return read_config<MarkerMotionConfig>(std::string(TACIPC_SOURCE_DIR) + "/configs/rivals/baseline/fots_markers.yaml")
      .fots;
}

TEST(FotsMarkers, LengthsAreThePublishedOnes) {
  const FotsMotion model = published();  // 1 / √λ
  EXPECT_NEAR(1.0 / std::sqrt(model.press_per_m2), 1.44e-3, 5e-6);
  EXPECT_NEAR(1.0 / std::sqrt(model.shear_per_m2), 3.52e-3, 5e-6);
  EXPECT_NEAR(1.0 / std::sqrt(model.twist_per_m2), 2.62e-3, 5e-6);
}

// One marker in contact at (1, 0) mm, 0.5 mm deep; another at rest at (2, 0.5) mm.
TEST(FotsMarkers, ThreeMotionsAboutOneContact) {
  const FotsMotion model = published();
  const Eigen::Vector2d at(2e-3, 0.5e-3);
  const std::vector<ContactPoint> contact{{.place_m = {1e-3, 0.0}, .depth_m = 0.5e-3}};
  const ObjectMotion still{.center_m = {1e-3, 0.0}};
  // 0.5 (1, 0.5) mm exp(−0.47922 · 1.25)
  const Eigen::Vector2d press = 0.5 * std::exp(-0.47922 * 1.25) * Eigen::Vector2d(1e-3, 0.5e-3);
  EXPECT_NEAR((fots_displacement(at, contact, still, model) - press).norm(), 0.0, 1e-15);
  EXPECT_EQ(fots_displacement({1e-3, 0.0}, contact, still, model).norm(), 0.0) << "nothing pushes itself";

  ObjectMotion sheared = still;
  sheared.shift_m = {0.0, 0.6e-3};
  const double apart = ((at + press) * 1e3 - Eigen::Vector2d(1.0, 0.0)).squaredNorm();
  const Eigen::Vector2d shear = press + std::exp(-0.080509 * apart) * sheared.shift_m;
  EXPECT_NEAR((fots_displacement(at, contact, sheared, model) - shear).norm(), 0.0, 1e-15);

  ObjectMotion turned = sheared;
  turned.turn_rad = std::numbers::pi / 6.0;
  const Eigen::Vector2d arm = at + shear - Eigen::Vector2d(1e-3, 0.0);
  const double c = std::sqrt(0.75) - 1.0, s = 0.5;
  const Eigen::Vector2d twist =
      std::exp(-0.145683e6 * arm.squaredNorm()) * Eigen::Vector2d(c * arm.x() - s * arm.y(), s * arm.x() + c * arm.y());
  EXPECT_NEAR((fots_displacement(at, contact, turned, model) - shear - twist).norm(), 0.0, 1e-15);

  ObjectMotion far = sheared;
  far.turn_rad = 2.0;
  ObjectMotion limit = sheared;
  limit.turn_rad = 50.0 * std::numbers::pi / 180.0;
  EXPECT_EQ(fots_displacement(at, contact, far, model), fots_displacement(at, contact, limit, model));
}

TEST(NonNegativeLeastSquares, TheFreeSolutionWhereItIsPositiveElseTheBoundary) {
  Eigen::MatrixXd a(3, 2);
  a << 1, 0.5, 0.5, 1, 0, 0.25;
  const Eigen::Vector2d truth(0.7, 0.2);
  EXPECT_NEAR((non_negative_least_squares(a, a * truth) - truth).norm(), 0.0, 1e-8);
  // With (1, −1) as the free solution, the second is held at 0: x₁ = a₁ · b / a₁ · a₁.
  const Eigen::VectorXd b = a * Eigen::Vector2d(1.0, -1.0);
  const Eigen::VectorXd x = non_negative_least_squares(a, b);
  EXPECT_EQ(x[1], 0.0);
  EXPECT_NEAR(x[0], a.col(0).dot(b) / a.col(0).squaredNorm(), 1e-12);
}

/// A lattice of 9 × 7 nodes, 0.5 mm apart; responses that fall off with the distance.
MarkerGrid lattice() {
  MarkerGrid grid;
  grid.rows = 7;
  grid.columns = 9;
  grid.pitch_m = 0.5e-3;
  return grid;
}

UnitResponse response() {
  UnitResponse out{.reach_x = 4, .reach_y = 3, .pressed = Positions(63, 3), .sheared = Positions(63, 3)};
  for (int dy = -3; dy <= 3; ++dy)
    for (int dx = -4; dx <= 4; ++dx) {
      const double r = std::hypot(dx, dy), fall = std::exp(-0.8 * r);
      const Eigen::Index row = (dy + 3) * 9 + dx + 4;
      out.pressed.row(row) << 0.1 * dx * fall, 0.1 * dy * fall, fall;
      out.sheared.row(row) << std::exp(-0.4 * std::hypot(dx, 2.0 * dy)), 0.05 * dx * dy * fall, 0.0;
    }
  return out;
}

TEST(UnitResponse, EndsAtItsLatticeAndTurnsWithTheLoad) {
  const UnitResponse unit = response();
  EXPECT_EQ(unit.press(5, 0), Vector3::Zero());
  EXPECT_EQ(unit.press(0, 0), Vector3(0.0, 0.0, 1.0));
  // Along y, two nodes on: what is along x two nodes on, turned.
  EXPECT_NEAR(unit.shear_y(0, 2).y(), unit.shear_x(2, 0).x(), 1e-15);
  EXPECT_NEAR(unit.shear_y(2, 0).y(), unit.shear_x(0, 2).x(), 1e-15) << "across";
  EXPECT_NE(unit.shear_y(2, 0).y(), unit.shear_x(2, 0).x());
}

TEST(Superposition, OneNodeGivesItsResponseAndManyTheirDepths) {
  std::vector<double> depth(63, 0.0);
  const std::size_t node = 3 * 9 + 3;
  depth[node] = 0.2e-3;
  const Superposition one(response(), lattice(), depth);
  const auto still = one.displacement(Eigen::Vector2d::Zero());
  EXPECT_NEAR((still[node + 1] - 0.2e-3 * response().press(1, 0).head<2>()).norm(), 0.0, 1e-12);
  EXPECT_EQ(still[node].norm(), 0.0);
  const auto moved = one.displacement({0.3e-3, 0.0});
  EXPECT_NEAR(moved[node].x(), 0.3e-3, 1e-12) << "the node goes with the object";
  EXPECT_NEAR((moved[node + 9] - still[node + 9]).x(), 0.3e-3 * response().shear_x(0, 1).x(), 1e-12);

  // A shallow neighbour that the deep one presses down already carries nothing, and moves as it makes it move.
  depth[node + 1] = 0.2e-3 * std::exp(-0.8) * 0.5;
  const Superposition two(response(), lattice(), depth);
  EXPECT_EQ(two.displacement(Eigen::Vector2d::Zero())[node].norm(), 0.0);
  depth[node + 1] = 0.2e-3;
  // Two alike carry alike, so each node is pushed away by the other: f = 0.2 mm / (1 + e^−0.8).
  const auto both = Superposition(response(), lattice(), depth).displacement(Eigen::Vector2d::Zero());
  const double load = 0.2e-3 / (1.0 + std::exp(-0.8));
  EXPECT_NEAR(both[node + 1].x(), 0.1 * std::exp(-0.8) * load, 1e-9);
  EXPECT_NEAR(both[node].x(), -0.1 * std::exp(-0.8) * load, 1e-9);
  EXPECT_EQ(Superposition(response(), lattice(), std::vector<double>(63, 0.0)).displacement({1.0, 0.0})[5].norm(), 0.0)
      << "without contact nothing moves";
}

}  // namespace marker_motion_test
}  // namespace tacipc
