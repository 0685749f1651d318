#include "stages/image/calibrate/gauss_newton.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace tacipc {
namespace {

void add_uncertainty(GaussNewtonResult& result, const Eigen::MatrixXd& jtj, Eigen::Index rows) {
  const Eigen::Index n = jtj.rows();
  const Eigen::VectorXd scale = jtj.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * jtj * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scaled);
  const double low = eigen.eigenvalues().minCoeff();
  result.condition =
      low > 0.0 ? std::sqrt(eigen.eigenvalues().maxCoeff() / low) : std::numeric_limits<double>::infinity();
  const Eigen::MatrixXd inverse = eigen.eigenvectors() *
                                  eigen.eigenvalues().cwiseMax(1e-300).cwiseInverse().asDiagonal() *
                                  eigen.eigenvectors().transpose();
  const double variance = result.sum_of_squares / static_cast<double>(std::max<Eigen::Index>(rows - n, 1));
  result.inverse = scale.asDiagonal() * inverse * scale.asDiagonal();
  result.covariance = variance * result.inverse;
}

}  // namespace

GaussNewtonResult gauss_newton(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& residuals,
                               const Eigen::VectorXd& start, const GaussNewtonSettings& settings) {
  constexpr int kMaxRejections = 6;
  GaussNewtonResult result{.parameters = start};
  Eigen::VectorXd r = residuals(start);
  result.sum_of_squares = r.squaredNorm();
  double damping = 1e-3;
  const Eigen::Index n = start.size();
  Eigen::MatrixXd jacobian(r.size(), n), jtj;
  while (!result.converged && result.iterations < settings.max_iterations) {
    ++result.iterations;
    for (Eigen::Index i = 0; i < n; ++i) {
      Eigen::VectorXd moved = result.parameters;
      // Backward difference if the forward step would leave the bounds.
      const double step = moved[i] + settings.step[i] > settings.upper[i] ? -settings.step[i] : settings.step[i];
      moved[i] += step;
      jacobian.col(i) = (residuals(moved) - r) / step;
    }
    jtj = jacobian.transpose() * jacobian;
    const Eigen::VectorXd slope = jacobian.transpose() * r;
    result.converged = true;  // unless a step improves it
    for (int attempt = 0; attempt < kMaxRejections; ++attempt, damping *= 10.0) {
      Eigen::MatrixXd system = jtj;
      system.diagonal() += damping * jtj.diagonal().cwiseMax(1e-300);
      const Eigen::VectorXd wanted = result.parameters - system.ldlt().solve(slope);
      const Eigen::VectorXd next = wanted.cwiseMax(settings.lower).cwiseMin(settings.upper);
      const Eigen::VectorXd r_next = residuals(next);
      const double squares = r_next.squaredNorm();
      if (!(squares < result.sum_of_squares)) continue;
      result.converged = squares > (1.0 - settings.relative_decrease) * result.sum_of_squares;
      result.parameters = next;
      result.sum_of_squares = squares;
      r = r_next;
      damping = std::max(damping / 10.0, 1e-9);
      break;
    }
  }
  if (jtj.size() > 0) add_uncertainty(result, jtj, r.size());
  return result;
}

}  // namespace tacipc
