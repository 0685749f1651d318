// Gradient and Hessian of the squared distance, by convergence order, for every type of closest feature.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "stages/gel/press/contact/distance.h"
#include "tests/stages/gel/press/contact/random_points.h"
#include "tests/stages/gel/press/convergence_order.h"

namespace tacipc {
namespace distance_derivatives_test {

struct Case {
  const char* name;
  ClosestFeature (*closest)(const FourPoints&);
  FourPoints x;
  int k;

  friend void PrintTo(const Case& entry, std::ostream* out) { *out << entry.name; }
};

const Case kCases[] = {
    {"point_triangle_inside",
     closest_point_triangle,
     {Vector3(0.4, 0.5, 0.7), Vector3(0, 0.1, 0), Vector3(2, 0, 0.3), Vector3(0.2, 1.9, -0.2)},
     2},
    {"point_triangle_edge",
     closest_point_triangle,
     {Vector3(1.1, -0.8, 0.6), Vector3(0, 0.1, 0), Vector3(2, 0, 0.3), Vector3(0.2, 1.9, -0.2)},
     1},
    {"point_triangle_vertex",
     closest_point_triangle,
     {Vector3(3.1, -0.8, 0.6), Vector3(0, 0.1, 0), Vector3(2, 0, 0.3), Vector3(0.2, 1.9, -0.2)},
     0},
    {"edge_edge_inside",
     closest_edge_edge,
     {Vector3(-1, 0.1, 0.2), Vector3(1.2, 0, -0.1), Vector3(0.2, -0.9, 0.8), Vector3(-0.1, 1.1, 1)},
     2},
    {"edge_edge_end_of_first",
     closest_edge_edge,
     {Vector3(0.1, 0.9, 0.1), Vector3(0.3, 2, 0.5), Vector3(-1, 0.1, 0.2), Vector3(1.2, 0, -0.1)},
     1},
    {"edge_edge_end_of_second",
     closest_edge_edge,
     {Vector3(-1, 0.1, 0.2), Vector3(1.2, 0, -0.1), Vector3(0.1, 0.9, 0.1), Vector3(0.3, 2, 0.5)},
     1},
    {"edge_edge_vertices",
     closest_edge_edge,
     {Vector3(-1, 0.1, 0.2), Vector3(1.2, 0, -0.1), Vector3(2.1, 0.9, 0.1), Vector3(3.3, 2, 0.5)},
     0},
};

FourPoints moved(const FourPoints& x, const Vector12& direction, double step) {
  FourPoints y = x;
  for (int i = 0; i < 4; ++i) y[i] += step * direction.segment<3>(3 * i);
  return y;
}

class DistanceDerivatives : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Features, DistanceDerivatives, testing::ValuesIn(kCases),
                         [](const auto& test) { return test.param.name; });

TEST_P(DistanceDerivatives, ConvergeAtSecondOrder) {
  const auto& [name, closest, x, k] = GetParam();
  const ClosestFeature here = closest(x);
  ASSERT_EQ(here.k, k);
  const Vector12 gradient = squared_distance_gradient(here);
  const Matrix12 hessian = squared_distance_hessian(here);
  std::mt19937 random(5);
  for (int trial = 0; trial < 6; ++trial) {
    Vector12 p;
    for (double& entry : p) entry = random_unit(random);
    const auto gradient_error = [&](double step) {
      const double plus = closest(moved(x, p, step)).squared_distance;
      const double minus = closest(moved(x, p, -step)).squared_distance;
      return std::abs((plus - minus) / (2 * step) - gradient.dot(p));
    };
    const auto hessian_error = [&](double step) {
      const Vector12 plus = squared_distance_gradient(closest(moved(x, p, step)));
      const Vector12 minus = squared_distance_gradient(closest(moved(x, p, -step)));
      return ((plus - minus) / (2 * step) - hessian * p).norm();
    };
    if (k == 0) {  // exactly quadratic: no error but rounding
      EXPECT_LT(gradient_error(1e-2), 1e-12);
      EXPECT_LT(hessian_error(1e-2), 1e-12);
    } else {
      EXPECT_NEAR(convergence_order(gradient_error, 4e-3), 2, 0.1);
      EXPECT_NEAR(convergence_order(hessian_error, 4e-3), 2, 0.1);
    }
  }
}

TEST_P(DistanceDerivatives, KnowNothingOfRigidMotion) {
  const auto& [name, closest, x, k] = GetParam();
  const ClosestFeature here = closest(x);
  const Vector12 gradient = squared_distance_gradient(here);
  const Matrix12 hessian = squared_distance_hessian(here);
  EXPECT_LT((hessian - hessian.transpose()).norm(), 1e-14);
  Vector3 force = Vector3::Zero(), torque = Vector3::Zero();
  for (int i = 0; i < 4; ++i) {
    force += gradient.segment<3>(3 * i);
    torque += x[i].cross(gradient.segment<3>(3 * i));
  }
  EXPECT_LT(force.norm(), 1e-14);
  EXPECT_LT(torque.norm(), 1e-13);
  for (int c = 0; c < 3; ++c) {
    Vector12 translation = Vector12::Zero();
    for (int i = 0; i < 4; ++i) translation[3 * i + c] = 1;
    EXPECT_LT((hessian * translation).norm(), 1e-13);
  }
}

TEST_P(DistanceDerivatives, GramInverseInvertsTheGramMatrix) {
  const ClosestFeature f = GetParam().closest(GetParam().x);
  const Eigen::Matrix2d product = inverse_gram(f) * (f.A.transpose() * f.A);
  Eigen::Matrix2d expected = Eigen::Matrix2d::Zero();
  expected.topLeftCorner(f.k, f.k).setIdentity();
  EXPECT_LT((product - expected).norm(), 1e-14);
}

}  // namespace distance_derivatives_test
}  // namespace tacipc
