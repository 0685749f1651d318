// Barrier function of contact pairs: zero beyond d̂, infinite at contact.
#pragma once

#include <cmath>
#include <limits>

namespace tacipc {

/// b(s) = −(s − ŝ)² ln(s / ŝ) for 0 < s < ŝ, 0 beyond; +∞ for s ≤ 0 [Eq. 4 with squared distances; Li et al. 2020]. s
/// and ŝ = d̂² are in m², the result is in m⁴. C² at ŝ, so that Newton's method meets no jump.
inline double barrier(double squared_distance, double s_hat) {
  const double s = squared_distance;
  if (s >= s_hat) return 0.0;
  if (s <= 0.0) return std::numeric_limits<double>::infinity();
  return -(s - s_hat) * (s - s_hat) * std::log(s / s_hat);
}

/// b′(s) = (ŝ − s)(2 ln(s/ŝ) − (ŝ − s)/s), in m². Derivation: −2(s − ŝ) ln(s/ŝ) − (s − ŝ)²/s, then factor out (ŝ − s).
inline double barrier_d1(double squared_distance, double s_hat) {
  const double s = squared_distance;
  if (s >= s_hat) return 0.0;
  return (s_hat - s) * (2.0 * std::log(s / s_hat) - (s_hat - s) / s);
}

/// b″(s) = −2 ln(s/ŝ) + (ŝ − s)(3s + ŝ)/s², dimensionless. Derivation: differentiate −2(s − ŝ) ln(s/ŝ) − (s − ŝ)²/s
/// once more: −2 ln(s/ŝ) − 4(s − ŝ)/s + (s − ŝ)²/s² and join the last two over s².
inline double barrier_d2(double squared_distance, double s_hat) {
  const double s = squared_distance;
  if (s >= s_hat) return 0.0;
  return -2.0 * std::log(s / s_hat) + (s_hat - s) * (3.0 * s + s_hat) / (s * s);
}

}  // namespace tacipc
