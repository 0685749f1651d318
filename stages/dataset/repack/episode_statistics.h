// Statistics of a column of a LeRobot dataset: per episode for meta/episodes, over all frames for meta/stats.json.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "common/base/value.h"
#include "common/format/parquet_writer.h"
#include "stages/dataset/repack/feature_statistics.h"

namespace tacipc {

/// Collects the statistics of one column.
class EpisodeStatistics {
 public:
  EpisodeStatistics(std::string name, std::size_t width, bool image)
      : name_(std::move(name)), total_(width), image_(image) {}

  /// Empty statistics of one episode, to be filled frame by frame.
  FeatureStatistics begin_episode() const { return FeatureStatistics(total_.width()); }
  void end_episode(const FeatureStatistics& episode);

  /// Appends columns `stats/<name>/<statistic>` with a row for each episode: lists of the column's width, for images
  /// (channels, 1, 1); `count`, the number of frames, is a list of one.
  void append_columns(std::vector<ParquetColumn>& columns, std::vector<ParquetValues>& values) const;
  /// Statistics over all frames, with the column's name.
  std::pair<std::string, Value> lines() const;

 private:
  std::string name_;
  FeatureStatistics total_;
  bool image_;
  std::array<std::vector<double>, kStatistics.size()> columns_;
  std::vector<std::int64_t> counts_;
};

}  // namespace tacipc
