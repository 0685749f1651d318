// The shards' tables joined in the order of the plan, and counted.
#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <string>

#include "stages/dataset/card/shard_records.h"

namespace tacipc {

/// Smallest and largest of a column.
struct Extent {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};

struct DatasetCounts {
  std::map<std::string, int> status;                           // made, failed, unmade
  std::map<std::string, std::map<std::string, int>> made;      // by column (split, sensor, object, motion) and word
  std::map<std::string, std::map<std::string, int>> not_made;  // the same of those that are not
  std::map<std::string, std::map<std::string, int>> outcomes;  // of made fingers of grasps, by outcome and split
  std::map<std::string, Extent> extents;                       // of made samples, by column of the manifest
};

/// Walks over the plan and takes each sample's row from its shard's tables, writing manifest.csv, failures.csv,
/// timings.csv and splits/… through `output`, which gives the path for a name. One row of each shard is in memory.
/// \throw DataError if a shard of the plan is not there, or its tables are not those of the plan
DatasetCounts join_tables(const std::filesystem::path& plan, const ShardRecords& records,
                          const std::function<std::filesystem::path(const std::string&)>& output);

}  // namespace tacipc
