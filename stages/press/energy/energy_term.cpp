#include "stages/press/energy/energy_term.h"

#include <Eigen/Eigenvalues>

namespace tacipc {

void project_psd(Matrix12& matrix) {
  const Eigen::SelfAdjointEigenSolver<Matrix12> eigen(matrix);
  if (eigen.eigenvalues()[0] >= 0.0) return;
  const Matrix12& q = eigen.eigenvectors();
  matrix = q * eigen.eigenvalues().cwiseMax(0.0).asDiagonal() * q.transpose();
}

}  // namespace tacipc
