#include "stages/gel/press/contact/body_frame.h"

#include <Eigen/LU>
#include <Eigen/SVD>

namespace tacipc {

BodyFrame body_frame(const Eigen::Ref<const Positions>& rest, const Eigen::Ref<const Positions>& x) {
  const Eigen::RowVector3d rest_mean = rest.colwise().mean(), mean = x.colwise().mean();
  Matrix3 moment = Matrix3::Zero();
  for (Eigen::Index v = 0; v < x.rows(); ++v) moment += (x.row(v) - mean).transpose() * (rest.row(v) - rest_mean);
  const Eigen::JacobiSVD<Matrix3> svd(moment, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Matrix3 U = svd.matrixU();
  // The nearest orthogonal matrix may be a reflection; the nearest rotation flips its least significant direction.
  if ((U * svd.matrixV().transpose()).determinant() < 0.0) U.col(2) = -U.col(2);
  return {U * svd.matrixV().transpose(), rest_mean};
}

}  // namespace tacipc
