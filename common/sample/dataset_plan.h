// The samples of a planned dataset (samples.csv), and why one is not finished.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "common/format/csv.h"
#include "common/stage/record.h"

namespace tacipc {

/// One row of samples.csv, which `plan` writes.
struct PlannedRow {
  std::string id;
  std::string index;
  std::string split;       // split of a division by object
  std::string split_pose;  // split of a division by pose
  std::string seed;
  std::string sensor;
  std::string mesh;
  std::string object;
  std::string motion;
  std::string shard;
  std::string folder;  // path relative to the dataset
};

/// A column of samples.csv, as docs/files.md lists it.
struct PlanColumn {
  const char* name;
  std::string PlannedRow::*value;
  const char* meaning;
};
/// Returns the columns in the order of the file.
std::span<const PlanColumn> plan_columns();

/// Returns the line of column names, or the line of a sample.
std::string plan_header();
std::string plan_line(const PlannedRow& row);

/// Reads the current row of samples.csv.
/// \throw DataError with file and line if a column is missing, the id cannot be part of a path, the folder is not below
/// the dataset's, or index or seed is no whole number ≥ 0
PlannedRow planned_row(const CsvReader& rows, const std::filesystem::path& samples_csv);

/// Calls `use` for every sample of a shard, or of the whole plan, in the order of the table. Holds one row in memory at
/// a time.
/// \throw DataError as planned_row(), or if the plan has no such shard
void for_each_planned(const std::filesystem::path& samples_csv, const std::optional<std::string>& shard,
                      const std::function<void(const PlannedRow&)>& use);

/// Reason why a sample is not finished.
struct Failure {
  std::string stage;
  std::string reason;
  std::string frame = {};  // frame of the failed verdict; check, value and limit belong to the same verdict
  std::string check = {};
  std::string value = {};
  std::string limit = {};
  bool made_nothing = false;  // neither a record nor a failure file exists
};

/// Returns why a sample is not finished; nothing if both records exist.
std::optional<Failure> failure_of(const std::filesystem::path& sample_folder);

}  // namespace tacipc
