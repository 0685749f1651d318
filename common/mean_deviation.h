// Mean and standard deviation of a list of numbers.
#pragma once

#include <cassert>
#include <cmath>
#include <vector>

namespace tacipc {

struct MeanDeviation {
  double mean = 0.0;
  double deviation = 0.0;  // over n, not n − 1
};

/// Where a number is infinite (PSNR of equal images) the mean is too, and the deviation is NaN. \pre not empty
inline MeanDeviation mean_and_deviation(const std::vector<double>& values) {
  assert(!values.empty());
  const auto n = static_cast<double>(values.size());
  double sum = 0.0, squares = 0.0;
  for (const double value : values) sum += value;
  const double mean = sum / n;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {.mean = mean, .deviation = std::sqrt(squares / n)};
}

}  // namespace tacipc
