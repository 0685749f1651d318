#include "stages/gel/press/drive/way_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace tacipc {
namespace way_search_test {

constexpr double kStep_s = 0.01, kMost_m = 2e-4, kReach_m = 2e-5;

/// A finger on a spring that begins at a gap of its own.
struct Spring {
  double stiffness_n_m, gap_m;
  DriveInertia inertia = {};
  double step_s = kStep_s;
  GripControl drive = {};
  int tries = 0;

  double grip_after(double closing_m) const {
    return stiffness_n_m * std::max(0.0, drive.closed_m + closing_m - gap_m + kReach_m);
  }
  void step() {
    WaySearch search(drive, inertia, step_s, kMost_m, kReach_m,
                     [&](double none) { return std::min(none, gap_m - drive.closed_m); });
    for (tries = 1;; ++tries) {
      EXPECT_LE(std::abs(search.way_m()), kMost_m);
      search.note(grip_after(search.way_m()));
      if (search.stands()) break;
      search.correct();
    }
    end(search.way_m(), search.found_n_m());
  }
  void end(double closing_m, std::optional<double> found_n_m = {}) {
    const double grip_n = grip_after(closing_m);
    drive.closed_m += closing_m;
    drive.measure(step_s, closing_m, grip_n, found_n_m);
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
    EXPECT_LT(most, 1.021) << stiffness;
  }
}

/// A step that was short while something else changed the grip says that all is stiff, or soft.
TEST(GripControl, RecoversFromAWrongGuessWithinAStep) {
  for (const double wrong : {1e-3, 1e4}) {
    Spring spring{3e3, 1e-4};
    spring.drive.grip(1.0);
    for (int i = 0; i < 30; ++i) spring.step();
    spring.drive.stiffness_n_m *= wrong;
    spring.drive.grip(1.1);
    spring.step();
    EXPECT_NEAR(spring.drive.last_grip_n, 1.1, 0.0221) << wrong;
    EXPECT_NEAR(spring.drive.stiffness_n_m, 3e3, 3.0) << wrong;
  }
}

/// A grip that jumps from far below the force to far above it has no balance.
TEST(WaySearch, SaysHowFarFromBalanceItGaveUp) {
  GripControl drive;
  drive.grip(1.0);
  drive.last_grip_n = 0.5;
  drive.stiffness_n_m = 3e3;
  drive.last_step_m = 1e-4;
  const auto gap = [](double none) { return none; };
  WaySearch search(drive, {}, kStep_s, kMost_m, kReach_m, gap);
  EXPECT_GT(search.imbalance(), 0.02);
  int tries = 0;
  for (;; ++tries, search.correct()) {
    search.note(search.way_m() < 1.23e-4 ? 0.5 : 1.5);
    if (search.stands()) break;
  }
  EXPECT_EQ(tries, 7);
  EXPECT_NEAR(search.imbalance(), search.way_m() < 1.23e-4 ? 0.5 : 0.5 / 1.5, 1e-12);
  // One that may not go farther is on its way, and one that has found the balance is not off it.
  WaySearch bound(drive, {}, kStep_s, 1e-5, kReach_m, gap), found(drive, {}, kStep_s, kMost_m, kReach_m, gap);
  bound.note(0.5);
  EXPECT_TRUE(bound.stands());
  EXPECT_EQ(bound.imbalance(), 0.0);
  found.note(1.01);
  EXPECT_NEAR(found.imbalance(), 0.01 / 1.01, 1e-12);
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

TEST(GripControl, GripsFromWhereAWayHasTakenIt) {
  Spring spring{3e3, 1e-4};
  spring.drive.go_to(4.5e-4);
  EXPECT_FALSE(spring.drive.arrived());
  spring.end(2e-4);
  EXPECT_FALSE(spring.drive.arrived());
  spring.end(2.5e-4);
  EXPECT_TRUE(spring.drive.arrived());
  EXPECT_NEAR(spring.drive.last_grip_n, 3e3 * 3.7e-4, 1e-9);
  EXPECT_EQ(spring.drive.wanted_n, spring.drive.last_grip_n);
  spring.drive.by_way = false;
  spring.step();
  EXPECT_DOUBLE_EQ(spring.drive.closed_m, 4.5e-4);
}

/// A contact that gets a hundred times stiffer: the next way is never so far that it presses too hard at the end.
TEST(GripControl, DoesNotOvershootWhereContactStiffens) {
  Spring spring{500.0, 1e-4};
  spring.drive.grip(0.25);
  for (int i = 0; i < 30; ++i) spring.step();
  spring.stiffness_n_m = 5e4;
  spring.gap_m = spring.drive.closed_m + kReach_m - spring.drive.last_grip_n / 5e4;
  for (const double wanted : {0.5, 0.75, 1.0}) {
    spring.drive.grip(wanted);
    spring.step();
    EXPECT_LT(spring.drive.last_grip_n, 1.021 * wanted);
  }
  EXPECT_NEAR(spring.drive.last_grip_n, 1.0, 0.02);
}

/// Freely, v tends to F/c, by the implicit step's factor m/(m + c h) of what is left; never faster than it may.
TEST(GripControl, ClosesFreelyAsItsMassAndDampingLetIt) {
  const DriveInertia inertia{.mass_kg = 0.2, .damping_n_s_m = 100.0};
  Spring spring{3e3, 1.0, inertia};
  spring.drive.grip(0.5);
  const double left = 0.2 / (0.2 + 100.0 * kStep_s);
  for (int n = 1; n <= 10; ++n) {
    spring.step();
    EXPECT_EQ(spring.tries, 1);
    EXPECT_NEAR(spring.drive.velocity_m_s, 5e-3 * (1.0 - std::pow(left, n)), 1e-9) << n;
  }
  spring.drive.grip(10.0);
  for (int n = 0; n < 10; ++n) spring.step();
  EXPECT_DOUBLE_EQ(spring.drive.velocity_m_s, kMost_m / kStep_s);
}

/// From free motion into the spring: the force at rest is the commanded one, whatever drive.
TEST(GripControl, ComesToRestWithTheCommandedForce) {
  for (const DriveInertia inertia : {DriveInertia{}, {0.2, 0.0}, {0.0, 100.0}, {0.5, 50.0}, {1e-9, 1e-9}}) {
    for (const double stiffness : {300.0, 3e3, 3e4}) {
      Spring spring{stiffness, 1e-3, inertia};
      spring.drive.grip(1.0);
      for (int i = 0; i < 400; ++i) spring.step();
      EXPECT_NEAR(spring.drive.last_grip_n, 1.0, 5e-3) << inertia.mass_kg << " " << inertia.damping_n_s_m;
      EXPECT_TRUE(spring.drive.arrived(inertia));
    }
  }
}

/// x'' + c/m x' + k/m x = 0 about the balance, in implicit steps: of (x, v) the complex eigenvalue λ per step, whose
/// angle is 2π h/period and whose modulus the decay. Small steps: those of the damped oscillator itself.
TEST(GripControl, SwingsAboutTheBalanceAsADampedOscillator) {
  constexpr double kMass = 0.2, kDamping = 8.0, kStiffness = 3e3;
  for (const double h : {1e-2, 2e-3, 1e-4}) {
    Spring spring{kStiffness, 1e-4, {kMass, kDamping}, h};
    // At rest in the spring under 1 N, then 1.2 N are wanted.
    spring.drive = {.wanted_n = 1.2,
                    .closed_m = 1e-4 - kReach_m + 1.0 / kStiffness,
                    .last_grip_n = 1.0,
                    .stiffness_n_m = kStiffness};
    const double a = kMass + h * kDamping + h * h * kStiffness;
    // x_{n+1} (m + c h + k h²) = x_n (2 m + c h) − x_{n−1} m, hence λ² a − λ (2 m + c h) + m = 0.
    const double p = (2.0 * kMass + h * kDamping) / (2.0 * a), q = kMass / a;
    ASSERT_LT(p * p, q);
    const double modulus = std::sqrt(q), angle = std::acos(p / modulus);
    std::vector<double> off{-0.2};
    for (int i = 0; i < 40; ++i) {
      spring.step();
      off.push_back(spring.drive.last_grip_n - 1.2);
    }
    // x_n = modulusⁿ (A cos nφ + B sin nφ), with x_{−1} = x_0 as it began at rest.
    const double A = -0.2, B = (A * std::cos(angle) - A * modulus) / std::sin(angle);
    for (std::size_t n = 0; n < off.size(); ++n) {
      const double t = angle * static_cast<double>(n);
      EXPECT_NEAR(off[n], std::pow(modulus, n) * (A * std::cos(t) + B * std::sin(t)), 1e-9) << h << " " << n;
    }
    if (h < 1e-3) {
      const double rate = 0.5 * kDamping / kMass, omega = std::sqrt(kStiffness / kMass - rate * rate);
      EXPECT_NEAR(angle / h, omega, 0.01 * omega);
      // The scheme damps by ω² h/2 besides.
      EXPECT_NEAR(-std::log(modulus) / h, rate + 0.5 * h * kStiffness / kMass, 0.02 * rate);
    }
  }
}

/// Passing the wanted force at speed is not arriving.
TEST(GripControl, HasNotArrivedWhileItSwings) {
  const DriveInertia inertia{.mass_kg = 0.2};
  GripControl drive{.wanted_n = 1.0, .velocity_m_s = 1e-3, .last_grip_n = 1.0, .stiffness_n_m = 3e3};
  EXPECT_FALSE(drive.arrived(inertia));  // v √(m k) = 0.024 N
  drive.velocity_m_s = 5e-4;
  EXPECT_TRUE(drive.arrived(inertia));
}

TEST(GripControl, IsLostOnceTheObjectIsFreeAndUntouched) {
  Spring spring{3e3, 1e-4};
  EXPECT_FALSE(spring.drive.lost());
  spring.drive.let_go = true;
  EXPECT_TRUE(spring.drive.lost());
  spring.drive.measure(kStep_s, 1e-5, 0.1);
  EXPECT_FALSE(spring.drive.lost());
}

}  // namespace way_search_test
}  // namespace tacipc
