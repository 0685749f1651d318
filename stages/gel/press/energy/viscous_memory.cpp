#include "stages/gel/press/energy/viscous_memory.h"

#include <Eigen/Eigenvalues>
#include <cassert>
#include <numeric>
#include <utility>

namespace tacipc {
namespace {

/// V M : E as a function of F − I, so that a gel at rest has no rounding energy.
double tet_value(const RestTet& tet, const Matrix3& M, const TetCorners& x) {
  const Matrix3 D = x * tet.shape_gradients.transpose() - Matrix3::Identity();
  return tet.volume_m3 * M.cwiseProduct(D + 0.5 * D.transpose() * D).sum();
}

TetCorners tet_gradient(const RestTet& tet, const Matrix3& M, const TetCorners& x) {
  const Matrix3 F = x * tet.shape_gradients.transpose();
  return tet.volume_m3 * (F * M) * tet.shape_gradients;
}

}  // namespace

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

TetCorners ViscousMemory::corners(int i, const Positions& x) const {
  TetCorners out;
  for (int k = 0; k < 4; ++k) out.col(k) = x.row(stencil(i)[static_cast<std::size_t>(k)]).transpose();
  return out;
}

double ViscousMemory::value(const Positions& x) const {
  return ordered_sum(num_stencils(), [&](int first, int last) {
    double sum = 0.0;
    for (int i = first; i < last; ++i) sum += tet_value(rest(i), stress(i), corners(i, x));
    return sum;
  });
}

TetCorners ViscousMemory::gradient(int i, const Positions& x) const {
  return tet_gradient(rest(i), stress(i), corners(i, x));
}

void ViscousMemory::evaluate(int i, const Eigen::VectorXd& x, Order order, Local& out) const {
  const RestTet& tet = rest(i);
  const Matrix3 M = stress(i);
  const TetPoints points(x.data());
  out.zero = false;
  out.fit(4, order);
  out.value = tet_value(tet, M, points);
  if (order == Order::value) return;
  Eigen::Map<TetCorners>(out.gradient.data()) = tet_gradient(tet, M, points);
  if (order == Order::gradient) return;
  Matrix3 kept = M;
  if (order == Order::psd) {
    const Eigen::SelfAdjointEigenSolver<Matrix3> eigen(M);
    const Matrix3& Q = eigen.eigenvectors();
    kept = Q * eigen.eigenvalues().cwiseMax(0.0).asDiagonal() * Q.transpose();
  }
  const auto& b = tet.shape_gradients;
  const Eigen::Matrix4d products = tet.volume_m3 * (b.transpose() * kept * b);
  out.hessian.setZero();
  for (int j = 0; j < 4; ++j) {
    for (int k = 0; k < 4; ++k) out.hessian.block<3, 3>(3 * k, 3 * j).diagonal().setConstant(products(k, j));
  }
}

}  // namespace tacipc
