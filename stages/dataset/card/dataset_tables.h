// Joins the shards' tables in the order of the plan, and counts samples.
#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <string>

#include "stages/dataset/card/shard_records.h"

namespace tacipc {

/// Smallest and largest value of a column.
struct Extent {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};

/// Counts of a dataset's samples, and extents of their numbers.
struct DatasetCounts {
  std::map<std::string, int> status;  // number of samples by made, failed, unmade
  std::map<std::string, std::map<std::string, int>>
      made;  // made samples by column (split, sensor, object, motion) and word
  std::map<std::string, std::map<std::string, int>> not_made;  // samples that are not made, by column and word
  std::map<std::string, std::map<std::string, int>> outcomes;  // made fingers of grasps by outcome and split
  std::map<std::string, Extent> extents;                       // extents over made samples, by column of the manifest
};

/// Takes each sample's row of the plan from its shard's tables, and writes manifest.csv, failures.csv, timings.csv and
/// splits/…. One row of each shard is in memory.
/// \param output gives the path for a file name
/// \throw DataError if a shard of the plan is missing, or its tables do not belong to the plan
DatasetCounts join_tables(const std::filesystem::path& plan, const ShardRecords& records,
                          const std::function<std::filesystem::path(const std::string&)>& output);

}  // namespace tacipc
