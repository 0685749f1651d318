// Fits the most probable mechanics, with uncertainties and posterior draws.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "stages/study/identify/model.h"

namespace tacipc {

/// Result of the fit.
struct Fit {
  Eigen::VectorXd u;           // most probable unknowns
  Eigen::MatrixXd covariance;  // covariance of u near the optimum, (JᵀJ)⁻¹ with the priors' rows in J
  int iterations = 0;
};

/// Minimises |residuals|² within the bounds by the Levenberg–Marquardt method with central differences (Ceres). If the
/// rows of a measurement (eight or more) deviate more than their standard deviations predict, these grow to the root
/// mean square of the deviations and the fit is repeated. The model's error then does not count as certainty.
/// \throw DataError if the fit does not converge
Fit fit_mechanics(MechanicsModel& model);

/// Least cost with one unknown held at a value and all others fitted again.
struct ProfilePoint {
  double value = 0.0;
  double cost = 0.0;  // |residuals|² above the minimum
};
/// Cost profile at even steps over ± 3 standard deviations, within the bounds.
std::vector<ProfilePoint> profile(const MechanicsModel& model, const Fit& fit, Eigen::Index unknown, int points);

/// Draws from the posterior. They come from a multivariate Student distribution (five degrees of freedom) around the
/// optimum, and are weighted by the ratio of both densities. No draw lies outside the bounds.
struct Posterior {
  Eigen::MatrixXd u;             // one column per draw
  Eigen::VectorXd weight;        // weights of the draws, sum 1
  double effective_draws = 0.0;  // 1 / Σ weight²

  double mean(const Eigen::VectorXd& values) const { return weight.dot(values); }
  Eigen::VectorXd mean_u() const { return u * weight; }
  double deviation(const Eigen::VectorXd& values) const;
  /// Value below which this fraction of the weight lies.
  double quantile(const Eigen::VectorXd& values, double share) const;
  /// Ascending columns of an even sample of the weights (systematic resampling).
  std::vector<Eigen::Index> resampled(int count) const;
};
Posterior draw_posterior(const MechanicsModel& model, const Fit& fit, int draws, int seed);

/// Standard deviation of u by the prior alone, including its bounds.
double prior_deviation(const Unknown& unknown);
/// True if the measurements determine an unknown, false if it is still the prior: they must at least halve its
/// variance.
bool told_by_measurements(const Unknown& unknown, double deviation_u);

}  // namespace tacipc
