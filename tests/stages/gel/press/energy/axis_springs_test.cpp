// Derivatives by differences are in energy_term_test.
#include "stages/gel/press/energy/axis_springs.h"

#include <gtest/gtest.h>

#include "stages/gel/press/energy/inertia.h"

namespace tacipc {
namespace axis_springs_test {

Local evaluated(const EnergyTerm& term, const Vector3& x, Order order) {
  Local local;
  term.evaluate(0, x, order, local);
  return local;
}

const Vector3 kTarget(0.1, -0.2, 0.3), kAt(0.4, 0.2, -0.1);

TEST(AxisSprings, PullsAlongEachAxisByItsOwnStiffness) {
  const AxisSprings springs(7, {2.0, 0.0, 50.0}, kTarget);
  ASSERT_EQ(springs.num_stencils(), 1);
  EXPECT_EQ(springs.stencil(0).front(), 7);
  const Local local = evaluated(springs, kAt, Order::hessian);
  EXPECT_NEAR(local.value, 0.5 * 2.0 * 0.09 + 0.5 * 50.0 * 0.16, 1e-14);
  EXPECT_LT((local.gradient - Vector3(0.6, 0.0, -20.0)).norm(), 1e-14);
  EXPECT_EQ(Matrix3(local.hessian), Matrix3(Vector3(2.0, 0.0, 50.0).asDiagonal()));
}

/// To the bit: a load's results are those of a mass.
TEST(AxisSprings, OfOneStiffnessAreAnInertia) {
  const double mass = 0.0123;
  const AxisSprings springs(4, Vector3::Constant(mass), kTarget);
  const Inertia inertia(Eigen::VectorXd::Constant(1, mass), Positions(kTarget.transpose()), 4);
  const Local a = evaluated(springs, kAt, Order::hessian), b = evaluated(inertia, kAt, Order::hessian);
  EXPECT_EQ(a.value, b.value);
  EXPECT_EQ(a.gradient, b.gradient);
  EXPECT_EQ(a.hessian, b.hessian);
}

}  // namespace axis_springs_test
}  // namespace tacipc
