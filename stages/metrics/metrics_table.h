// All metrics of all pairs, as a table and as means.
#pragma once

#include <string>
#include <vector>

#include "common/value.h"
#include "stages/metrics/image_pairs.h"
#include "stages/metrics/metrics_config.h"

namespace tacipc {

/// The larger SSIM window must fit.
inline constexpr int kLeastSide = 11;

/// One image, one crop of it or one box in it, against its reference.
struct MetricsRow {
  std::string name;
  std::string region;  // full, crop or box
  double mae = 0.0;
  double mse = 0.0;
  double psnr_db = 0.0;
  double psnr_ln = 0.0;
  double ssim_w = 0.0;
  double ssim_s = 0.0;
  double sharpness = 0.0;
};

/// Rows in the order of the pairs, after the whole image the crop, then the box; pairs run in parallel. \throw
/// DataError for unreadable images, different sizes, images below 11 pixels, a crop or box that leaves the image, an
/// image without a box.
std::vector<MetricsRow> measure(const std::vector<ImagePair>& pairs, const MetricsConfig& config);

/// CSV with a header line; numbers in the shortest form that reads back to the same bits, infinity as inf.
std::string to_csv(const std::vector<MetricsRow>& rows);

/// Per region: number of images, mean and standard deviation (over n, not n − 1) of each metric, and the decibels of
/// the mean MSE. Where an image equals its reference the PSNR has an infinite mean and no standard deviation (NaN).
Value::Map summary_of(const std::vector<MetricsRow>& rows);

}  // namespace tacipc
