// Steps that invert no tetrahedron.
#include <gtest/gtest.h>

#include <random>

#include "stages/gel/press/solve/step_limit.h"

namespace tacipc {
namespace {

TEST(CubicStaysAbove, NeverSaysYesForACubicThatDips) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-2.0, 2.0);
  int yes = 0, dips = 0;
  for (int trial = 0; trial < 5000; ++trial) {
    const double c[4] = {1.0, uniform(random), uniform(random), uniform(random)};
    double lowest = 1.0;
    for (int k = 0; k <= 1000; ++k) {
      const double t = 1e-3 * k;
      lowest = std::min(lowest, c[0] + t * (c[1] + t * (c[2] + t * c[3])));
    }
    const bool says = cubic_stays_above(c, 1.0, 0.1);
    EXPECT_FALSE(says && lowest <= 0.1) << c[1] << " " << c[2] << " " << c[3];
    yes += says;
    dips += lowest <= 0.1;
  }
  EXPECT_GT(yes, 1000);
  EXPECT_GT(dips, 500);
}

TEST(InversionStepLimit, StopsBeforeAVertexPassesThroughItsFace) {
  const Positions x{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  Positions p = Positions::Zero(4, 3);
  p(3, 2) = -4.0;  // flat at t = 1/4, a tenth of the volume left at t = 0.225
  const double t = inversion_step_limit(Tetrahedra{{0, 1, 2, 3}}, x, p);
  EXPECT_LT(t, 0.225);
  EXPECT_GT(t, 0.75 * 0.225);
  p(3, 2) = 4.0;
  EXPECT_EQ(inversion_step_limit(Tetrahedra{{0, 1, 2, 3}}, x, p), 1.0);
}

TEST(InversionStepLimit, SeesATurnThatEndsUprightAgain) {
  // Through the face and out on the other side of a moving base: positive volume at both ends, not between.
  const Positions x{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  Positions p = Positions::Zero(4, 3);
  p.row(1) << -2, 0, 0;
  p.row(2) << 0, -2, 0;
  EXPECT_LT(inversion_step_limit(Tetrahedra{{0, 1, 2, 3}}, x, p), 0.5);
}

}  // namespace
}  // namespace tacipc
