// Metrics of images or depth maps against references, as a table and as means.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/base/value.h"

namespace tacipc {

/// Returns 10 log₁₀(1 / mse) in decibels, for values between 0 and 1; +∞ for equal images.
double psnr_db(double mse);

/// Metrics of one region of one image or depth map.
struct MetricsRow {
  std::string name;
  std::string region;
  std::vector<std::pair<const char*, double>> values;  // column and number; all rows have the same columns

  /// Returns the number of a column.
  /// \pre the column exists
  double operator[](std::string_view column) const;
};

/// Returns CSV with a header line; numbers in the shortest form that reads back to the same bits, infinity as inf.
/// \pre not empty
std::string to_csv(const std::vector<MetricsRow>& rows);

/// Returns per region: number of images, mean and standard deviation (over n, not n − 1) of each column, and the
/// decibels of the mean MSE if there is a column `mse`. If an image equals its reference, the PSNR's mean is infinite
/// and its standard deviation NaN.
Value::Map summary_of(const std::vector<MetricsRow>& rows);

}  // namespace tacipc
