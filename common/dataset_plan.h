// The plan's samples and what became of them.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "common/record.h"

namespace tacipc {

/// One row of samples.csv.
struct PlannedRow {
  std::string id;
  std::string index;
  std::string split;       // by object
  std::string split_pose;  // by pose
  std::string seed;
  std::string sensor;
  std::string mesh;
  std::string object;
  std::string motion;
  std::string shard;
  std::filesystem::path folder;  // as the table says, relative to the dataset
};

/// Calls `use` for every sample of a shard, or of all, in the order of the table, of which one row at a time is in
/// memory. \throw DataError if a column is missing, an id names no part of a path, or the plan has no such shard
void for_each_planned(const std::filesystem::path& samples_csv, const std::optional<std::string>& shard,
                      const std::function<void(const PlannedRow&)>& use);

/// Why there is no finished sample.
struct Failure {
  std::string stage;
  std::string reason;
  std::string frame = {};  // of the verdict that failed, with what follows
  std::string check = {};
  std::string value = {};
  std::string limit = {};
  bool made_nothing = false;  // neither a record nor a failure is there
};

/// Nothing if both records are there.
std::optional<Failure> failure_of(const std::filesystem::path& sample_folder);

}  // namespace tacipc
