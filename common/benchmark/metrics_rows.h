// What was measured of images or depth maps against references, as a table and as means.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/base/value.h"

namespace tacipc {

/// 10 log₁₀(1 / mse) in decibels, of numbers between 0 and 1; +∞ for equal images.
double psnr_db(double mse);

/// One region of one image or depth map against its reference.
struct MetricsRow {
  std::string name;
  std::string region;
  std::vector<std::pair<const char*, double>> values;  // column and number; the same columns in all rows

  /// \pre there is such a column
  double operator[](std::string_view column) const;
};

/// CSV with a header line; numbers in the shortest form that reads back to the same bits, infinity as inf.
/// \pre not empty
std::string to_csv(const std::vector<MetricsRow>& rows);

/// Per region: number of images, mean and standard deviation (over n, not n − 1) of each column, and the decibels of
/// the mean MSE where there is a `mse`. Where an image equals its reference the PSNR has an infinite mean and no
/// standard deviation (NaN).
Value::Map summary_of(const std::vector<MetricsRow>& rows);

}  // namespace tacipc
