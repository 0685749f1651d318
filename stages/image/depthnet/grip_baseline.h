// Baseline that predicts a grasp's outcome from the grip force alone.
#pragma once

#include <vector>

namespace tacipc {

/// Logistic regression on one variable: probability 1 / (1 + exp(−(intercept + slope × grip))).
struct GripBaseline {
  double intercept = 0.0;
  double slope = 0.0;  // per newton

  double probability(double grip_n) const;
};

/// Most likely regression, with a weight of 10⁻⁶ per grasp on the squared slope per standard deviation, which keeps the
/// slope finite if the force separates the outcomes.
/// \pre both lists have the same length, with at least one grasp held and one not held
GripBaseline fit_grip_baseline(const std::vector<double>& grips_n, const std::vector<bool>& held);

}  // namespace tacipc
