#include "stages/rival/mpm/half_speed.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tacipc {
namespace half_speed_test {

TEST(SpeedEffect, ComparesDisplacementsSinceRest) {
  const Positions rest{{5, 5, 0}, {7, 5, 0}};
  Positions far = rest, farther = rest, first = rest, second = rest;
  first.col(0).array() += 0.01;  // hardly moved: cannot be the worst frame
  far.col(0).array() += 1.0;
  farther.col(0).array() += 2.0;
  second = farther;
  second(0, 1) += 0.3;
  second(1, 1) += 0.4;
  const SpeedEffect effect = speed_effect({rest, rest, far, second}, {rest, first, far, farther});
  EXPECT_DOUBLE_EQ(effect.last_frame, std::sqrt(0.25 / 8.0));
  EXPECT_DOUBLE_EQ(effect.worst_frame, effect.last_frame);
  EXPECT_EQ(effect.worst, 3u);
  EXPECT_DOUBLE_EQ(effect.change, std::sqrt((2e-4 + 0.25) / (2e-4 + 2.0 + 8.0)));
  EXPECT_EQ(speed_effect({rest, far}, {rest, far}).change, 0.0);
}

}  // namespace half_speed_test
}  // namespace tacipc
