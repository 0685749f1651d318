// The check every derivative gets: halve the step, and a central difference's error must fall fourfold.
#pragma once

#include <cmath>

namespace tacipc {

/// log₂ of the ratio of errors at `step` and `step / 2`; 2 for a central difference against the right derivative, 0
/// against a wrong one.
template <typename Error>
double convergence_order(Error&& error, double step) {
  return std::log2(error(step) / error(0.5 * step));
}

}  // namespace tacipc
