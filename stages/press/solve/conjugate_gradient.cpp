#include "stages/press/solve/conjugate_gradient.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace tacipc {

std::unique_ptr<LinearSolver> make_linear_solver(LinearSolverKind kind) {
  if (kind == LinearSolverKind::direct) return std::make_unique<CholmodSolver>();
  return std::make_unique<ConjugateGradient>();
}

bool ConjugateGradient::prepare(const BlockMatrix& matrix) {
  matrix_ = &matrix;
  const BlockPattern& pattern = *matrix.pattern;
  inverse_diagonal_.resize(static_cast<std::size_t>(pattern.size()));
  for (int c = 0; c < pattern.size(); ++c) {
    const Eigen::Map<const Matrix3> block(matrix.values.data() + 9 * static_cast<std::size_t>(pattern.column_start[c]));
    const Eigen::LLT<Matrix3> factor(block);
    if (factor.info() != Eigen::Success) return false;
    inverse_diagonal_[static_cast<std::size_t>(c)] = factor.solve(Matrix3::Identity());
  }
  return true;
}

std::optional<Eigen::VectorXd> ConjugateGradient::factorize(const Eigen::VectorXd& b) {
  ++factorized_;
  if (!direct_.prepare(*matrix_)) return std::nullopt;
  return direct_.solve(b);
}

std::optional<Eigen::VectorXd> ConjugateGradient::solve(const Eigen::VectorXd& b) {
  const auto preconditioned = [&](const Eigen::VectorXd& r) {
    Eigen::VectorXd z(r.size());
    for (std::size_t i = 0; i < inverse_diagonal_.size(); ++i) {
      const auto at = 3 * static_cast<Eigen::Index>(i);
      z.segment<3>(at) = inverse_diagonal_[i] * r.segment<3>(at);
    }
    return z;
  };
  Eigen::VectorXd x = Eigen::VectorXd::Zero(b.size()), r = b, z = preconditioned(r), p = z;
  double rz = r.dot(z);
  const double enough = tolerance_ * tolerance_ * rz;
  for (int i = 0; rz > enough; ++i) {
    if (i == max_products_) return factorize(b);
    const Eigen::VectorXd q = matrix_->multiply(p);
    ++products_;
    const double curvature = p.dot(q);
    if (!(curvature > 0.0)) return std::nullopt;
    const double alpha = rz / curvature;
    x += alpha * p;
    r -= alpha * q;
    z = preconditioned(r);
    const double last = rz;
    rz = r.dot(z);
    p = z + (rz / last) * p;
  }
  return x;
}

}  // namespace tacipc
