// What was measured of all pairs, as a table and as means.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/base/value.h"
#include "stages/study/metrics/image_pairs.h"

namespace tacipc {

/// One region of one image or depth map against its reference.
struct MetricsRow {
  std::string name;
  std::string region;
  std::vector<std::pair<const char*, double>> values;  // column and number; the same columns in all rows

  /// \pre there is such a column
  double operator[](std::string_view column) const;
};

/// The rows of all pairs in their order; pairs run in parallel. Where several fail, the first one's error is thrown.
std::vector<MetricsRow> measure_pairs(const std::vector<ImagePair>& pairs,
                                      const std::function<std::vector<MetricsRow>(const ImagePair&)>& measure);

/// CSV with a header line; numbers in the shortest form that reads back to the same bits, infinity as inf.
/// \pre not empty
std::string to_csv(const std::vector<MetricsRow>& rows);

/// Per region: number of images, mean and standard deviation (over n, not n − 1) of each column, and the decibels of
/// the mean MSE where there is a `mse`. Where an image equals its reference the PSNR has an infinite mean and no
/// standard deviation (NaN).
Value::Map summary_of(const std::vector<MetricsRow>& rows);

}  // namespace tacipc
