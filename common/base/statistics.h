// Statistics of a list of numbers: mean, standard deviation, median, quantile.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace tacipc {

/// Mean and standard deviation.
struct MeanDeviation {
  double mean = 0.0;
  double deviation = 0.0;  // standard deviation over n, not n − 1
};

/// Returns mean and standard deviation. If a number is infinite (PSNR of equal images), the mean is infinite and the
/// deviation NaN.
/// \pre not empty
inline MeanDeviation mean_and_deviation(const std::vector<double>& values) {
  assert(!values.empty());
  const auto n = static_cast<double>(values.size());
  double sum = 0.0, squares = 0.0;
  for (const double value : values) sum += value;
  const double mean = sum / n;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {.mean = mean, .deviation = std::sqrt(squares / n)};
}

/// Returns the value with index `rank` of the sorted values.
/// \pre rank < number of values
template <typename T>
T ranked(std::vector<T> values, std::size_t rank) {
  assert(rank < values.size());
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/// Returns the middle value; for an even number of values, the mean of the middle two.
/// \pre not empty
template <typename T>
double median(std::vector<T> values) {
  assert(!values.empty());
  std::ranges::sort(values);
  return 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

/// Returns the middle value; for an even number of values, the larger of the middle two, so always one of the values.
/// \pre not empty
template <typename T>
T upper_median(std::vector<T> values) {
  const std::size_t middle = values.size() / 2;
  return ranked(std::move(values), middle);
}

/// Returns the quantile p by linear interpolation between sorted values, at index (n − 1) p (type 7 of Hyndman and Fan
/// 1996).
/// \pre values are sorted, at least one; 0 ≤ p ≤ 1
inline double quantile(const std::vector<double>& sorted, double p) {
  assert(!sorted.empty() && 0.0 <= p && p <= 1.0);
  const double at = p * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  if (below + 1 == sorted.size()) return sorted.back();
  const double part = at - static_cast<double>(below);
  return (1.0 - part) * sorted[below] + part * sorted[below + 1];
}

/// Returns the largest value that is not above the quantile p: index ⌊(n − 1) p⌋ of the sorted values. The input may
/// have any order.
/// \pre not empty, 0 ≤ p ≤ 1
inline double lower_quantile(std::vector<double> values, double p) {
  assert(!values.empty() && 0.0 <= p && p <= 1.0);
  const auto rank = static_cast<std::size_t>(p * static_cast<double>(values.size() - 1));
  return ranked(std::move(values), rank);
}

}  // namespace tacipc
