#include "stages/gel/press/contact/edge_edge_mollifier.h"

#include <gtest/gtest.h>

#include "tests/stages/gel/press/contact/random_points.h"
#include "tests/stages/gel/press/convergence_order.h"

namespace tacipc {
namespace edge_edge_mollifier_test {

Vector12 random_direction(std::mt19937& random) {
  Vector12 p;
  for (double& entry : p) entry = random_unit(random);
  return p;
}

FourPoints moved(const FourPoints& x, const Vector12& direction, double step) {
  FourPoints y = x;
  for (int i = 0; i < 4; ++i) y[i] += step * direction.segment<3>(3 * i);
  return y;
}

TEST(EdgeEdgeMollifier, TakesTheValuesOfItsFormula) {
  EXPECT_EQ(edge_edge_mollifier(0.0, 2.0), 0);
  EXPECT_EQ(edge_edge_mollifier(1.0, 2.0), 0.75);  // −¼ + 1
  EXPECT_EQ(edge_edge_mollifier(2.0, 2.0), 1);
  EXPECT_EQ(edge_edge_mollifier(9.0, 2.0), 1);
  EXPECT_EQ(edge_edge_mollifier_d1(2.0, 2.0), 0);
  EXPECT_EQ(edge_edge_mollifier_d1(0.0, 2.0), 1);
  EXPECT_EQ(edge_edge_mollifier_d2(1.0, 2.0), -0.5);
  EXPECT_EQ(edge_edge_mollifier_d2(3.0, 2.0), 0);
}

TEST(EdgeEdgeMollifier, ThresholdIsAThousandthOfTheRestLengths) {
  const FourPoints rest{Vector3(0, 0, 0), Vector3(2, 0, 0), Vector3(5, 5, 5), Vector3(5, 8, 5)};
  EXPECT_DOUBLE_EQ(edge_edge_mollifier_threshold(rest), 1e-3 * 4 * 9);
}

TEST(EdgeEdgeMollifier, CrossProductOfUprightAndParallelEdges) {
  const Vector3 o(0, 0, 0);
  EXPECT_EQ(edge_cross_squared_norm({o, Vector3(2, 0, 0), o, Vector3(0, 3, 0)}), 36);
  EXPECT_EQ(edge_cross_squared_norm({o, Vector3(2, 0, 0), Vector3(0, 1, 0), Vector3(7, 1, 0)}), 0);
  EXPECT_EQ(edge_cross_squared_norm_gradient({o, Vector3(2, 0, 0), Vector3(0, 1, 0), Vector3(7, 1, 0)}).norm(), 0);
}

TEST(EdgeEdgeMollifier, CrossProductDerivativesConvergeAtSecondOrder) {
  std::mt19937 random(6);
  for (int trial = 0; trial < 20; ++trial) {
    const FourPoints x = random_points(random);
    const Vector12 p = random_direction(random);
    const double slope = edge_cross_squared_norm_gradient(x).dot(p);
    const Vector12 bend = edge_cross_squared_norm_hessian(x) * p;
    const auto gradient_error = [&](double h) {
      return std::abs((edge_cross_squared_norm(moved(x, p, h)) - edge_cross_squared_norm(moved(x, p, -h))) / (2 * h) -
                      slope);
    };
    const auto hessian_error = [&](double h) {
      return ((edge_cross_squared_norm_gradient(moved(x, p, h)) - edge_cross_squared_norm_gradient(moved(x, p, -h))) /
                  (2 * h) -
              bend)
          .norm();
    };
    EXPECT_NEAR(convergence_order(gradient_error, 1e-2), 2, 0.05) << to_string(x);
    EXPECT_NEAR(convergence_order(hessian_error, 1e-2), 2, 0.05) << to_string(x);
  }
}

TEST(EdgeEdgeMollifier, DerivativesConvergeAtSecondOrder) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 20; ++trial) {
    const FourPoints x = random_points(random);
    const double epsilon = 3 * edge_cross_squared_norm(x);
    const Vector12 p = random_direction(random);
    const EdgeEdgeMollifier here = edge_edge_mollifier(x, epsilon);
    EXPECT_DOUBLE_EQ(here.value, edge_edge_mollifier(edge_cross_squared_norm(x), epsilon));
    EXPECT_LT((here.hessian - here.hessian.transpose()).norm(), 1e-13 * here.hessian.norm());
    const auto gradient_error = [&](double h) {
      const double plus = edge_edge_mollifier(moved(x, p, h), epsilon).value;
      const double minus = edge_edge_mollifier(moved(x, p, -h), epsilon).value;
      return std::abs((plus - minus) / (2 * h) - here.gradient.dot(p));
    };
    const auto hessian_error = [&](double h) {
      const Vector12 plus = edge_edge_mollifier(moved(x, p, h), epsilon).gradient;
      const Vector12 minus = edge_edge_mollifier(moved(x, p, -h), epsilon).gradient;
      return ((plus - minus) / (2 * h) - here.hessian * p).norm();
    };
    const double h = 2e-3 * std::min(1.0, std::sqrt(epsilon));
    EXPECT_NEAR(convergence_order(gradient_error, h), 2, 0.1) << to_string(x);
    EXPECT_NEAR(convergence_order(hessian_error, h), 2, 0.1) << to_string(x);
  }
}

TEST(EdgeEdgeMollifier, LeavesEdgesAtAnAngleAlone) {
  const Vector3 o(0, 0, 0);
  const FourPoints x{o, Vector3(1, 0, 0), o, Vector3(1, 0.1, 0)};
  const EdgeEdgeMollifier m = edge_edge_mollifier(x, edge_edge_mollifier_threshold(x));
  EXPECT_EQ(m.value, 1);
  EXPECT_EQ(m.gradient.norm(), 0);
  EXPECT_EQ(m.hessian.norm(), 0);
}

}  // namespace edge_edge_mollifier_test
}  // namespace tacipc
