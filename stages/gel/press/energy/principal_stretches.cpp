#include "stages/gel/press/energy/principal_stretches.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace tacipc {

PrincipalStretches principal_stretches(const Matrix3& F) {
  constexpr double kOrthogonal = 1e-15;  // cosine between two columns below which they count as orthogonal
  constexpr int kMaxSweeps = 40;         // five are usual; a bound for columns at the limit of kOrthogonal
  PrincipalStretches out{F, {}, Matrix3::Identity()};
  Matrix3& B = out.U;  // F V, whose columns become orthogonal
  bool rotated = true;
  for (int sweep = 0; rotated && sweep < kMaxSweeps; ++sweep) {
    rotated = false;
    for (int p = 0; p < 2; ++p) {
      for (int q = p + 1; q < 3; ++q) {
        const double a = B.col(p).squaredNorm(), b = B.col(q).squaredNorm(), g = B.col(p).dot(B.col(q));
        if (std::abs(g) <= kOrthogonal * std::sqrt(a * b)) continue;
        rotated = true;
        // tan of the angle that makes the columns orthogonal: the smaller root of t² + 2ζt − 1 = 0, ζ = (b − a)/(2g).
        const double zeta = (b - a) / (2.0 * g);
        const double t = (zeta < 0.0 ? -1.0 : 1.0) / (std::abs(zeta) + std::sqrt(1.0 + zeta * zeta));
        const double c = 1.0 / std::sqrt(1.0 + t * t), s = c * t;
        const Vector3 b_p = B.col(p), v_p = out.V.col(p);
        B.col(p) = c * b_p - s * B.col(q);
        B.col(q) = s * b_p + c * B.col(q);
        out.V.col(p) = c * v_p - s * out.V.col(q);
        out.V.col(q) = s * v_p + c * out.V.col(q);
      }
    }
  }
  out.sigma = B.colwise().norm();
  for (int p = 0; p < 3; ++p) B.col(p) /= out.sigma[p];
  return out;
}

void PrincipalTangent::project() {
  const Eigen::SelfAdjointEigenSolver<Matrix3> eigen(stretch);
  if (eigen.eigenvalues()[0] < 0.0) {
    stretch = eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).asDiagonal() * eigen.eigenvectors().transpose();
  }
  twist = twist.cwiseMax(0.0);
  flip = flip.cwiseMax(0.0);
}

void PrincipalTangent::add_pressure(double pressure, const Vector3& sigma) {
  for (int r = 0; r < 3; ++r) {
    const int p = (r + 1) % 3, q = (r + 2) % 3;
    const double share = pressure * sigma[r];
    stretch(p, q) += share;
    stretch(q, p) += share;
    twist[r] += share;
    flip[r] -= share;
  }
}

}  // namespace tacipc
