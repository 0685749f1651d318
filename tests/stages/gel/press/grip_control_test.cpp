#include "stages/gel/press/grip_control.h"

#include <gtest/gtest.h>

namespace tacipc {
namespace {

constexpr double kMost_m = 2e-4, kReach_m = 2e-5;

/// A finger on a spring that begins at a gap of its own.
struct Spring {
  double stiffness_n_m, gap_m;
  GripControl drive = {};

  void step() {
    const double closing =
        drive.closing_step(kMost_m, kReach_m, [&](double none) { return std::min(none, gap_m - drive.closed_m); });
    EXPECT_LE(std::abs(closing), kMost_m);
    drive.closed_m += closing;
    drive.measure(closing, stiffness_n_m * std::max(0.0, drive.closed_m - gap_m + kReach_m));
  }
};

TEST(GripControl, ReachesAForceThroughASpringOfAnyStiffness) {
  for (const double stiffness : {300.0, 3e3, 3e4}) {
    Spring spring{stiffness, 1e-3};
    spring.drive.grip(1.0);
    double most = 0.0;
    for (int i = 0; i < 60 && !spring.drive.arrived(); ++i) {
      spring.step();
      most = std::max(most, spring.drive.last_grip_n);
    }
    EXPECT_NEAR(spring.drive.last_grip_n, 1.0, 0.02) << stiffness;
    EXPECT_LT(most, 1.05) << stiffness;
  }
}

/// A step that was short while something else changed the grip says that all is stiff.
TEST(GripControl, RecoversFromAMuchTooStiffGuess) {
  Spring spring{3e3, 1e-4};
  spring.drive.grip(1.0);
  for (int i = 0; i < 30; ++i) spring.step();
  spring.drive.stiffness_n_m *= 1e4;
  spring.drive.grip(2.0);
  for (int i = 0; i < 30; ++i) spring.step();
  EXPECT_NEAR(spring.drive.last_grip_n, 2.0, 0.04);
}

TEST(GripControl, OpensToASmallerForce) {
  Spring spring{3e3, 1e-4};
  spring.drive.grip(1.0);
  for (int i = 0; i < 30; ++i) spring.step();
  const double closed = spring.drive.closed_m;
  spring.drive.grip(0.5);
  EXPECT_FALSE(spring.drive.arrived());
  for (int i = 0; i < 30; ++i) spring.step();
  EXPECT_TRUE(spring.drive.arrived());
  EXPECT_NEAR(spring.drive.closed_m, closed - 0.5 / 3e3, 1e-5);
}

TEST(GripControl, GoesToAPlaceWhateverTheForceAndGripsFromThere) {
  Spring spring{3e3, 1e-4};
  spring.drive.go_to(4.5e-4);
  for (int i = 0; i < 3; ++i) {
    EXPECT_FALSE(spring.drive.arrived());
    spring.step();
  }
  EXPECT_TRUE(spring.drive.arrived());
  EXPECT_DOUBLE_EQ(spring.drive.closed_m, 4.5e-4);
  EXPECT_NEAR(spring.drive.last_grip_n, 3e3 * 3.7e-4, 1e-9);
  EXPECT_EQ(spring.drive.wanted_n, spring.drive.last_grip_n);
  spring.step();
  EXPECT_DOUBLE_EQ(spring.drive.closed_m, 4.5e-4);
}

TEST(GripControl, IsLostOnceTheObjectIsFreeAndUntouched) {
  Spring spring{3e3, 1e-4};
  EXPECT_FALSE(spring.drive.lost());
  spring.drive.let_go = true;
  EXPECT_TRUE(spring.drive.lost());
  spring.drive.measure(1e-5, 0.1);
  EXPECT_FALSE(spring.drive.lost());
}

}  // namespace
}  // namespace tacipc
