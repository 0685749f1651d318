#include "stages/gel/press/energy/orthogonality.h"

#include <algorithm>
#include <cmath>

namespace tacipc {

double orthogonality_pa(const AffineBody& body) {
  constexpr double kForce_n = 10.0, kStrain = 2e-4;
  const double area_m2 = std::cbrt(body.volume_m3) * std::cbrt(body.volume_m3);
  return std::max(kOrthogonalityPa, kForce_n / (8.0 * kStrain * area_m2));
}

Orthogonality::Orthogonality(int first_vertex, const AffineBody& body, double stiffness_pa)
    : vertices_{first_vertex, first_vertex + 1, first_vertex + 2, first_vertex + 3},
      gradients_per_m_(weight_gradients(body).transpose()),
      stiffness_j_(stiffness_pa * body.volume_m3) {}

void Orthogonality::evaluate(int, const Eigen::VectorXd& x, Order order, Local& out) const {
  const auto& g = gradients_per_m_;
  const Eigen::Map<const Eigen::Matrix<double, 3, 4>> p(x.data());
  // Relative to one of the points, so that a position far from the origin loses no digits.
  const Matrix3 A = (p.colwise() - p.col(0)) * g.transpose();
  const Matrix3 C = A.transpose() * A - Matrix3::Identity();
  out.zero = false;
  out.value = stiffness_j_ * C.squaredNorm();
  if (order == Order::value) return;

  out.fit(4, order);
  const double scale = 4.0 * stiffness_j_;
  Eigen::Map<Eigen::Matrix<double, 3, 4>>(out.gradient.data()) = scale * A * (C * g);
  if (order == Order::gradient) return;

  const Eigen::Matrix<double, 3, 4> a = A * g;
  const Eigen::Matrix4d stress = g.transpose() * C * g, gram = g.transpose() * g;
  const Matrix3 square = A * A.transpose();
  Matrix12 hessian;
  for (int j = 0; j < 4; ++j) {
    for (int k = 0; k < 4; ++k) {
      auto block = hessian.block<3, 3>(3 * k, 3 * j);
      block = scale * (a.col(j) * a.col(k).transpose() + gram(k, j) * square);
      block.diagonal().array() += scale * stress(k, j);
    }
  }
  if (order == Order::psd) project_psd(hessian);
  out.hessian = hessian;
}

}  // namespace tacipc
