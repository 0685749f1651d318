#include "stages/gel/press/energy/viscous_memory.h"

#include <Eigen/Eigenvalues>
#include <cassert>
#include <numeric>
#include <utility>

namespace tacipc {

ViscousMemory::ViscousMemory(std::shared_ptr<const RestBody> body, SymmetricRows stress_pa)
    : body_(std::move(body)),
      stress_pa_(std::make_shared<const SymmetricRows>(std::move(stress_pa))),
      which_(body_->rest.size()) {
  assert(stress_pa_->rows() == body_->tets.rows());
  std::iota(which_.begin(), which_.end(), 0);
}

ViscousMemory::ViscousMemory(const ViscousMemory& whole, const std::vector<int>& which)
    : body_(whole.body_), stress_pa_(whole.stress_pa_) {
  for (const int i : which) which_.push_back(whole.which_[static_cast<std::size_t>(i)]);
}

void ViscousMemory::evaluate(int i, const Eigen::VectorXd& x, Order order, Local& out) const {
  const int t = which_[static_cast<std::size_t>(i)];
  const RestTet& tet = body_->rest[static_cast<std::size_t>(t)];
  const auto& b = tet.shape_gradients;
  const double V = tet.volume_m3;
  const Matrix3 M = symmetric(*stress_pa_, t), F = TetPoints(x.data()) * b.transpose();
  // E written in F − I, so that a gel at rest has no energy of rounding.
  const Matrix3 D = F - Matrix3::Identity();
  out.zero = false;
  out.fit(4, order);
  out.value = V * M.cwiseProduct(D + 0.5 * D.transpose() * D).sum();
  if (order == Order::value) return;
  Eigen::Map<TetCorners>(out.gradient.data()) = V * (F * (M * b));
  if (order == Order::gradient) return;
  Matrix3 kept = M;
  if (order == Order::psd) {
    const Eigen::SelfAdjointEigenSolver<Matrix3> eigen(M);
    const Matrix3& Q = eigen.eigenvectors();
    kept = Q * eigen.eigenvalues().cwiseMax(0.0).asDiagonal() * Q.transpose();
  }
  const Eigen::Matrix4d products = V * (b.transpose() * kept * b);
  out.hessian.setZero();
  for (int j = 0; j < 4; ++j) {
    for (int k = 0; k < 4; ++k) out.hessian.block<3, 3>(3 * k, 3 * j).diagonal().setConstant(products(k, j));
  }
}

}  // namespace tacipc
