#include "stages/study/identify/node_grid.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tacipc {
namespace node_grid_test {

TEST(NodeGrid, IsExactForPolynomialsOfEachAxisBelowItsValues) {
  const NodeGrid grid({{0.45, 0.48, 0.495}, {3.0, 5.0}});
  ASSERT_EQ(grid.size(), 6);
  const auto f = [](double nu, double t) { return 1.0 + nu * nu * (2.0 - 3.0 * t) + t; };
  Eigen::VectorXd values(6);
  Eigen::Index i = 0;
  for (const double nu : {0.45, 0.48, 0.495})
    for (const double t : {3.0, 5.0}) values[i++] = f(nu, t);
  for (const auto& [nu, t] : {std::pair{0.46, 3.7}, {0.49, 4.9}, {0.45, 5.0}}) {
    const Eigen::VectorXd weights = grid.weights({nu, t});
    EXPECT_NEAR(weights.sum(), 1.0, 1e-12);
    EXPECT_NEAR(weights.dot(values), f(nu, t), 1e-11);
  }
}

TEST(NodeGrid, WithoutAxesIsOneNode) {
  EXPECT_EQ(NodeGrid({}).size(), 1);
  EXPECT_EQ(NodeGrid({}).weights({}), Eigen::VectorXd::Ones(1));
}

Curve sampled(double step, double (*f)(double)) {
  std::vector<double> x;
  std::vector<double> y;
  for (int i = 0; i * step < 2.0 + 0.5 * step; ++i) {
    x.push_back(i * step);
    y.push_back(f(i * step));
  }
  return {x, Eigen::Map<const Eigen::VectorXd>(y.data(), static_cast<Eigen::Index>(y.size())), kPressExponent};
}

double worst(double step) {
  const auto f = [](double x) { return std::pow(x, 1.5) * (1.0 + 0.6 * x + 0.3 * x * x); };
  const Curve curve = sampled(step, f);
  double most = 0.0;
  for (double x = 0.4; x < 1.9; x += 0.013) most = std::max(most, std::abs(curve.at(x) / f(x) - 1.0));
  return most;
}

TEST(Curve, ConvergesAndIsNearABallsForceOnFewFrames) {
  EXPECT_LT(worst(0.2), 2e-3);
  EXPECT_GT(std::log2(worst(0.2) / worst(0.1)), 1.8);
}

TEST(Curve, GoesThroughItsPointsRisesWithThemAndGoesOnBeyondTheLast) {
  const Curve curve = sampled(0.25, [](double x) { return x < 1.0 ? x : x + 5.0 * (x - 1.0); });
  for (int i = 0; i <= 8; ++i)
    EXPECT_NEAR(curve.at(0.25 * i), i < 4 ? 0.25 * i : 0.25 * i + 5.0 * (0.25 * i - 1.0), 1e-12);
  double last = 0.0;
  for (double x = 0.01; x < 2.5; x += 0.01) {
    EXPECT_GT(curve.at(x), last);
    last = curve.at(x);
  }
}

TEST(CurveTable, BlendsItsRows) {
  const CurveTable table{.x = {0.0, 1.0, 2.0}, .y = Eigen::MatrixXd{{0.0, 1.0, 2.0}, {0.0, 3.0, 8.0}}};
  EXPECT_NEAR(table.blend(Eigen::Vector2d(0.25, 0.75)).at(2.0), 0.25 * 2.0 + 0.75 * 8.0, 1e-12);
}

}  // namespace node_grid_test
}  // namespace tacipc
