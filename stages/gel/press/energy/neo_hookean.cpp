#include "stages/gel/press/energy/neo_hookean.h"

#include <Eigen/Dense>
#include <cmath>

namespace tacipc {

Matrix3 NeoHookean::stress(const Matrix3& F) const {
  const double a = mu_pa - lambda_pa * std::log(F.determinant());
  return mu_pa * F - a * F.inverse().transpose();
}

int negative_modes(const NeoHookean& material, const Matrix3& F, double pressure, NegativeMode modes[6]) {
  const double J = F.determinant(), mu = material.mu_pa;
  const double alpha = mu - material.lambda_pa * std::log(J) - pressure * J;
  const double beta = material.lambda_pa + pressure * J;
  const Eigen::SelfAdjointEigenSolver<Matrix3> eigen(F.transpose() * F);
  const Vector3 sigma = eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  const Matrix3& V = eigen.eigenvectors();
  const Matrix3 U = F * V * sigma.cwiseInverse().asDiagonal();
  int count = 0;
  for (int p = 0; p < 3; ++p) {
    for (int q = p + 1; q < 3; ++q) {
      const double share = alpha / (sigma[p] * sigma[q]);
      const double sign = alpha > 0.0 ? -1.0 : 1.0;  // a twist for α > 0, a flip for α < 0
      const double value = mu + sign * share;
      if (value >= 0.0) continue;
      modes[count++] = {value,
                        (U.col(p) * V.col(q).transpose() + sign * U.col(q) * V.col(p).transpose()) / std::sqrt(2.0)};
    }
  }
  if (alpha < 0.0 || beta < 0.0) {
    Matrix3 stretch = beta * sigma.cwiseInverse() * sigma.cwiseInverse().transpose();
    for (int p = 0; p < 3; ++p) stretch(p, p) += mu + alpha / (sigma[p] * sigma[p]);
    const Eigen::SelfAdjointEigenSolver<Matrix3> block(stretch);
    for (int m = 0; m < 3; ++m) {
      if (block.eigenvalues()[m] >= 0.0) continue;
      modes[count++] = {block.eigenvalues()[m], U * block.eigenvectors().col(m).asDiagonal() * V.transpose()};
    }
  }
  return count;
}

}  // namespace tacipc
