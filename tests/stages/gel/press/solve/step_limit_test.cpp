// Steps that invert no tetrahedron.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include "common/base/error.h"
#include "stages/gel/press/solve/step_limit.h"

namespace tacipc {
namespace step_limit_test {

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

TEST(InversionStepLimit, IsTheLeastOfAllWhereverInTheListTheyAre) {
  // Eight are looked at together: numbers that eight does not divide, each tetrahedron alone against all of them.
  constexpr int kTets = 1029;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Positions x(4 * kTets, 3), p(4 * kTets, 3);
  Tetrahedra tets(kTets, 4);
  for (int t = 0; t < kTets; ++t) {
    tets.row(t) << 4 * t, 4 * t + 1, 4 * t + 2, 4 * t + 3;
    x.middleRows<4>(4 * t) << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
    for (int k = 0; k < 4; ++k) p.row(4 * t + k) << 0.6 * uniform(random), 0.6 * uniform(random), 0.6 * uniform(random);
  }
  std::vector<double> alone;
  for (int t = 0; t < kTets; ++t) alone.push_back(inversion_step_limit(tets.row(t), x, p));
  EXPECT_EQ(*std::max_element(alone.begin(), alone.end()), 1.0);
  EXPECT_LT(*std::min_element(alone.begin(), alone.end()), 1.0);
  for (const int count : {1, 7, 8, 9, 513, kTets})
    EXPECT_EQ(inversion_step_limit(tets.topRows(count), x, p), *std::min_element(alone.begin(), alone.begin() + count))
        << count;
}

TEST(InversionStepLimit, RefusesAStepThatIsNoNumber) {
  const Positions x{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  Positions p = Positions::Zero(5, 3);
  p(4, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(inversion_step_limit(Tetrahedra{{0, 1, 2, 3}, {1, 2, 3, 4}}, x, p), SolverError);
}

TEST(InversionStepLimit, SeesATurnThatEndsUprightAgain) {
  // Through the face and out on the other side of a moving base: positive volume at both ends, not between.
  const Positions x{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  Positions p = Positions::Zero(4, 3);
  p.row(1) << -2, 0, 0;
  p.row(2) << 0, -2, 0;
  EXPECT_LT(inversion_step_limit(Tetrahedra{{0, 1, 2, 3}}, x, p), 0.5);
}

}  // namespace step_limit_test
}  // namespace tacipc
