#include "stages/image/depthnet/grip_baseline.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tacipc {
namespace grip_baseline_test {

TEST(GripBaseline, OfTwoForcesSaysTheShareThatHeldAtEach) {
  // Of four at 1 N one held, of four at 3 N three.
  const GripBaseline fit =
      fit_grip_baseline({1, 1, 1, 1, 3, 3, 3, 3}, {true, false, false, false, true, true, true, false});
  EXPECT_NEAR(fit.probability(1.0), 0.25, 1e-5);
  EXPECT_NEAR(fit.probability(3.0), 0.75, 1e-5);
  EXPECT_NEAR(fit.slope, std::log(3.0), 1e-4);
  EXPECT_NEAR(fit.intercept, -2.0 * std::log(3.0), 1e-4);
}

TEST(GripBaseline, StaysFiniteWhereAForceSeparatesAndWhereThereIsOneForce) {
  const GripBaseline separated = fit_grip_baseline({1, 2, 3, 4}, {false, false, true, true});
  EXPECT_TRUE(std::isfinite(separated.slope));
  EXPECT_LT(separated.probability(2.0), 0.01);
  EXPECT_GT(separated.probability(3.0), 0.99);
  const GripBaseline same = fit_grip_baseline({2, 2, 2, 2}, {false, true, true, true});
  EXPECT_EQ(same.slope, 0.0);
  EXPECT_NEAR(same.probability(2.0), 0.75, 1e-6);
}

}  // namespace grip_baseline_test
}  // namespace tacipc
