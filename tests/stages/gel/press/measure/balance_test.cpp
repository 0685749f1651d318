#include "stages/gel/press/measure/balance.h"

#include <gtest/gtest.h>

namespace tacipc {
namespace balance_test {

TEST(Balance, ForcesThatAddUpLeaveNothing) {
  // A bar along z, pressed at its top and held at its foot; weight and inertia halfway.
  const Positions x{{0, 0, 0}, {0, 0, -1}, {0, 0, -2}};
  const VertexForces forces{.contact = Positions{{0.25, 0, -4}, {0, 0, 0}, {0, 0, 0}},
                            .inertia = Positions{{0, 0, 0}, {0, 0, -0.75}, {0, 0, 0}},
                            .mount = Positions{{0, 0, 0}, {-0.25, 0, 0}, {0, 0, 4.75}}};
  const Balance balance = balance_of(x, forces);
  EXPECT_EQ(balance.force_n, 0.0);
  EXPECT_EQ(balance.relative, 0.0);
  EXPECT_EQ(balance.contact_n, Vector3(0.25, 0, -4));
  EXPECT_EQ(balance.inertia_n, Vector3(0, 0, -0.75));
  EXPECT_EQ(balance.mount_n, Vector3(-0.25, 0, 4.75));
  // The couple of the shear forces, a metre apart.
  EXPECT_DOUBLE_EQ(balance.torque_n_m, 0.25);
}

TEST(Balance, IsRelativeToTheContactForceButNeverToLessThanItsFloor) {
  const Positions x = Positions::Zero(1, 3);
  const auto of = [&](double contact_n, double left_n) {
    return balance_of(x, {.contact = Positions{{0, 0, -contact_n}}, .mount = Positions{{left_n, 0, contact_n}}});
  };
  EXPECT_DOUBLE_EQ(of(2.0, 1e-3).relative, 5e-4);
  EXPECT_DOUBLE_EQ(of(2.0, 1e-3).force_n, 1e-3);
  EXPECT_DOUBLE_EQ(of(0.0, 1e-5).relative, 1e-3);
  EXPECT_DOUBLE_EQ(of(0.005, 1e-5).relative, 1e-3);
  EXPECT_EQ(balance_of(x, {}).relative, 0.0);
}

}  // namespace balance_test
}  // namespace tacipc
