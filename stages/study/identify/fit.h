// The most probable mechanics, how certain each of them is, and draws of what they may be.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "stages/study/identify/model.h"

namespace tacipc {

struct Fit {
  Eigen::VectorXd u;           // the most probable unknowns
  Eigen::MatrixXd covariance;  // of u, (JᵀJ)⁻¹ with the priors' rows in J: near the optimum
  int iterations = 0;
};

/// Minimises |residuals|² within the bounds by Levenberg and Marquardt's method with central differences (Ceres). Where
/// the rows of a measurement (eight or more) deviate more than their deviations say, these grow to their root mean
/// square and the fit is repeated: the model's error is not to be taken for certainty. \throw DataError if it does not
/// converge
Fit fit_mechanics(MechanicsModel& model);

/// One value of an unknown held, all others fitted again.
struct ProfilePoint {
  double value = 0.0;
  double cost = 0.0;  // |residuals|² above the least
};
/// At even steps over ± 3 deviations, within the bounds.
std::vector<ProfilePoint> profile(const MechanicsModel& model, const Fit& fit, Eigen::Index unknown, int points);

/// Draws from the posterior: from a multivariate Student distribution (five degrees of freedom) about the optimum, with
/// the ratio of both densities as weights; none outside the bounds.
struct Posterior {
  Eigen::MatrixXd u;             // a column per draw
  Eigen::VectorXd weight;        // sum 1
  double effective_draws = 0.0;  // 1 / Σ weight²

  double mean(const Eigen::VectorXd& values) const { return weight.dot(values); }
  Eigen::VectorXd mean_u() const { return u * weight; }
  double deviation(const Eigen::VectorXd& values) const;
  /// Value below which this share of the weight lies.
  double quantile(const Eigen::VectorXd& values, double share) const;
  /// Columns of an even sample of the weights, ascending (systematic resampling).
  std::vector<Eigen::Index> resampled(int count) const;
};
Posterior draw_posterior(const MechanicsModel& model, const Fit& fit, int draws, int seed);

/// Deviation of u by the prior alone, its bounds included.
double prior_deviation(const Unknown& unknown);
/// Whether measurements told an unknown, or it is still what the prior says: they did where they halve its variance.
bool told_by_measurements(const Unknown& unknown, double deviation_u);

}  // namespace tacipc
