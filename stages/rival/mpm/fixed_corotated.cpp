#include "stages/rival/mpm/fixed_corotated.h"

#include <Eigen/SVD>

namespace tacipc {

Matrix3 nearest_rotation(const Matrix3& F) {
  const Eigen::JacobiSVD<Matrix3> svd(F, Eigen::ComputeFullU | Eigen::ComputeFullV);
  // The smallest singular value gets the sign: the particle inverted in its thinnest direction.
  Matrix3 signs = Matrix3::Identity();
  signs(2, 2) = svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0 ? -1.0 : 1.0;
  return svd.matrixU() * signs * svd.matrixV().transpose();
}

}  // namespace tacipc
