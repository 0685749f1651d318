// Damped Gauss–Newton for a few parameters (Levenberg 1944, Marquardt 1963).
#pragma once

#include <Eigen/Core>
#include <functional>

namespace tacipc {

/// Settings of the iteration.
struct GaussNewtonSettings {
  Eigen::VectorXd step;   // steps of the forward differences, per parameter
  Eigen::VectorXd lower;  // bounds; steps end there
  Eigen::VectorXd upper;
  int max_iterations = 20;
  double relative_decrease = 1e-5;  // the iteration ends if the sum of squares decreases by less than this fraction
};

/// Result of the iteration.
struct GaussNewtonResult {
  Eigen::VectorXd parameters;
  double sum_of_squares = 0.0;
  Eigen::MatrixXd covariance =
      {};  // σ² (JᵀJ)⁻¹ with σ² = sum of squares / (rows − parameters); assumes independent residuals
  Eigen::MatrixXd inverse = {};  // (JᵀJ)⁻¹: the covariance if residuals are in units of their standard deviations
  double condition = 0.0;        // condition of J with columns scaled to unit length
  int iterations = 0;
  bool converged = false;
};

/// Minimises |r(u)|² from `start`, with J by forward differences: (JᵀJ + λ diag JᵀJ) d = −Jᵀ r. λ grows tenfold after a
/// step that does not decrease |r|², and falls to a tenth after one that does.
/// \pre more residuals than parameters
GaussNewtonResult gauss_newton(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& residuals,
                               const Eigen::VectorXd& start, const GaussNewtonSettings& settings);

}  // namespace tacipc
