// Evaluates a network on images with known depth.
#pragma once

#include <vector>

#include "common/benchmark/metrics_rows.h"
#include "common/image/depth_sheet.h"
#include "stages/image/depthnet/network.h"
#include "stages/image/depthnet/training_set.h"

namespace tacipc {

/// Predictions of a network and their errors, as rows of the regions `full` and `pressed` in the format of `metrics`.
class Judge {
 public:
  explicit Judge(TrainedNetwork network) : network_(std::move(network)) {}

  /// Adds an image to the queue. The network evaluates several queued images at once.
  void add(const DepthImage& image);
  /// Evaluates the queued images.
  /// \throw DataError, naming the image, if the network does not accept its size
  void answer();

  const std::vector<MetricsRow>& rows() const { return rows_; }
  /// \pre there are rows
  ByteImage sheet() const { return depth_sheet(pictures_); }
  /// Number of images without contact, which have no rows.
  std::size_t untouched() const { return untouched_; }
  /// Images that differ from those of the training. Networks without statistics of the training images give no
  /// comparison.
  const LookReport& unlike() const { return unlike_; }
  double seen_untouched_mm() const { return seen_untouched_mm_ / static_cast<double>(untouched_); }

 private:
  void take(const DepthImage& image, const FloatImage& depth_mm);
  /// Keeps at most a dozen of many images of one size, evenly spread.
  void keep_picture(DepthRow row);

  TrainedNetwork network_;
  std::vector<DepthImage> waiting_;
  std::vector<MetricsRow> rows_;
  std::vector<DepthRow> pictures_;
  std::size_t offered_ = 0, stride_ = 1;  // every stride_-th offered image is kept
  std::size_t untouched_ = 0;
  double seen_untouched_mm_ = 0.0;
  LookReport unlike_;
};

}  // namespace tacipc
