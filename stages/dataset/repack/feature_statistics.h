// Least, greatest, mean and deviation of a feature over all frames, as LeRobot's meta/stats.json has them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "common/base/value.h"

namespace tacipc {

/// Of `width` interleaved numbers each by itself: the components of a vector, the channels of an image.
class FeatureStatistics {
 public:
  explicit FeatureStatistics(std::size_t width) : of_(width) {}

  template <typename T>
  void add(const std::vector<T>& values, double scale = 1.0) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      One& one = of_[i % of_.size()];
      const double value = scale * static_cast<double>(values[i]);
      if (std::isnan(value)) continue;
      one.least = std::min(one.least, value);
      one.greatest = std::max(one.greatest, value);
      ++one.count;
      const double before = value - one.mean;
      one.mean += before / static_cast<double>(one.count);
      one.squares += before * (value - one.mean);
    }
    ++frames_;
  }

  /// Lists of one number for each component; of images each number in two further lists, (channels, 1, 1).
  Value::Map value(bool image) const {
    const auto list = [&](auto&& number_of) {
      Value::List numbers;
      for (const One& one : of_) {
        const Value number = one.count > 0 ? number_of(one) : 0.0;
        numbers.push_back(image ? Value(Value::List{Value(Value::List{number})}) : number);
      }
      return Value(numbers);
    };
    return {{"min", list([](const One& one) { return one.least; })},
            {"max", list([](const One& one) { return one.greatest; })},
            {"mean", list([](const One& one) { return one.mean; })},
            {"std", list([](const One& one) { return std::sqrt(one.squares / static_cast<double>(one.count)); })},
            {"count", Value(Value::List{Value(frames_)})}};
  }

 private:
  struct One {
    double least = std::numeric_limits<double>::infinity(), greatest = -least;
    double mean = 0.0, squares = 0.0;  // Welford's sums
    std::int64_t count = 0;
  };
  std::vector<One> of_;
  std::int64_t frames_ = 0;
};

}  // namespace tacipc
