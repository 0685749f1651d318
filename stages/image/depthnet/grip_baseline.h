// What the force of the grip alone says of a grasp's outcome.
#pragma once

#include <vector>

namespace tacipc {

/// Logistic regression on one variable: probability 1 / (1 + exp(−(intercept + slope × grip))).
struct GripBaseline {
  double intercept = 0.0;
  double slope = 0.0;  // per newton

  double probability(double grip_n) const;
};

/// The most likely one, but for a weight of 10⁻⁶ per grasp on the squared slope per standard deviation, which keeps it
/// finite where a force separates the outcomes. \pre as many of both, not all held and not none
GripBaseline fit_grip_baseline(const std::vector<double>& grips_n, const std::vector<bool>& held);

}  // namespace tacipc
