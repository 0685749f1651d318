// A network judged by images whose depth is known.
#pragma once

#include <vector>

#include "common/benchmark/metrics_rows.h"
#include "common/image/depth_sheet.h"
#include "stages/image/depthnet/network.h"
#include "stages/image/depthnet/training_set.h"

namespace tacipc {

/// What a network says of images, and how far it is off: rows of the regions `full` and `pressed` as `metrics` has
/// them.
class Judge {
 public:
  explicit Judge(TrainedNetwork network) : network_(std::move(network)) {}

  /// Images wait until there are some to be answered side by side.
  void add(const DepthImage& image);
  /// Answers those that wait. \throw DataError naming the image if it is of another size than the network knows
  void answer();

  const std::vector<MetricsRow>& rows() const { return rows_; }
  /// \pre there are rows
  ByteImage sheet() const { return depth_sheet(pictures_); }
  /// Of images without contact, which have no rows: how many, and the mean of what the network sees in them, mm.
  std::size_t untouched() const { return untouched_; }
  /// Which images are unlike those of the network's training; of a network without their look none was compared.
  const LookReport& unlike() const { return unlike_; }
  double seen_untouched_mm() const { return seen_untouched_mm_ / static_cast<double>(untouched_); }

 private:
  void take(const DepthImage& image, const FloatImage& depth_mm);
  /// Keeps at most a dozen of many images of one size, spread over all of them.
  void keep_picture(DepthRow row);

  TrainedNetwork network_;
  std::vector<DepthImage> waiting_;
  std::vector<MetricsRow> rows_;
  std::vector<DepthRow> pictures_;
  std::size_t offered_ = 0, stride_ = 1;  // every so many of those offered is kept
  std::size_t untouched_ = 0;
  double seen_untouched_mm_ = 0.0;
  LookReport unlike_;
};

}  // namespace tacipc
