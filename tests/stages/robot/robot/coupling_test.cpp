// What a robot feels between two answers of a press.
#include "stages/robot/robot/coupling.h"

#include <gtest/gtest.h>

namespace tacipc {
namespace {

TEST(FeltWrench, IsTheAnswerWhereItWasGiven) {
  PadAnswer answer{.wrench = {{0.1, -0.2, -3.0}, {0.01, 0.0, 0.02}}};
  const Wrench felt = felt_wrench(answer, Vector3::Zero(), 5000.0);
  EXPECT_EQ(felt.force_n, answer.wrench.force_n);
  EXPECT_EQ(felt.torque_n_m, answer.wrench.torque_n_m);
}

}  // namespace
}  // namespace tacipc
