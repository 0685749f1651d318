// Statistics of a feature over frames, as LeRobot stores them for a dataset and for each episode.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <unordered_map>
#include <vector>

namespace tacipc {

/// Names of the results of FeatureStatistics::values, in its order.
inline constexpr std::array kStatistics{"min", "max", "mean", "std", "q01", "q10", "q50", "q90", "q99"};

/// Statistics of one number over all its occurrences; values that are not finite do not count.
class NumberStatistics {
 public:
  void add(double number, std::int64_t times = 1);
  void add(const NumberStatistics& other);

  /// Values of kStatistics; all 0 without numbers. A quantile q is the smallest number that at least a fraction q of
  /// all numbers do not exceed, with a relative resolution of 2^-15.
  std::array<double, kStatistics.size()> values() const;

 private:
  std::array<double, 5> quantiles() const;

  double least_ = std::numeric_limits<double>::infinity(), greatest_ = -least_;
  double mean_ = 0.0, squares_ = 0.0;  // Welford's sums
  std::int64_t count_ = 0;
  /// Counts of numbers that agree in sign, exponent and 15 bits of the mantissa; keys have the order of the numbers.
  std::unordered_map<std::uint32_t, std::int64_t> counts_;
};

/// Statistics of each of `width` interleaved numbers: components of a vector, channels of an image.
class FeatureStatistics {
 public:
  explicit FeatureStatistics(std::size_t width) : of_(width) {}

  void add_frame(std::span<const double> values);
  void add_frame(std::span<const float> values);
  /// Adds 8-bit values of a picture, divided by 255.
  void add_frame(std::span<const std::uint8_t> codes);
  void add(const FeatureStatistics& other);

  std::size_t width() const { return of_.size(); }
  std::int64_t frames() const { return frames_; }
  /// Values of kStatistics for each number.
  std::array<std::vector<double>, kStatistics.size()> values() const;

 private:
  std::vector<NumberStatistics> of_;
  std::int64_t frames_ = 0;
};

}  // namespace tacipc
