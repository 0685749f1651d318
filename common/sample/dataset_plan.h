// The plan's samples and their results.
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
  std::string split;       // by object
  std::string split_pose;  // by pose
  std::string seed;
  std::string sensor;
  std::string mesh;
  std::string object;
  std::string motion;
  std::string shard;
  std::string folder;  // relative to the dataset
};

/// A column of samples.csv: the table that docs/files.md shows.
struct PlanColumn {
  const char* name;
  std::string PlannedRow::*value;
  const char* meaning;
};
/// In the order of the file.
std::span<const PlanColumn> plan_columns();

/// The line of column names, and that of a sample.
std::string plan_header();
std::string plan_line(const PlannedRow& row);

/// The row that a reader of samples.csv is at. \throw DataError with file and line if a column is missing, the id names
/// no part of a path, the folder does not lie below the dataset's, or index or seed is no whole number from 0
PlannedRow planned_row(const CsvReader& rows, const std::filesystem::path& samples_csv);

/// Calls `use` for every sample of a shard, or of all, in the order of the table, of which one row at a time is in
/// memory. \throw DataError as planned_row, or if the plan has no such shard
void for_each_planned(const std::filesystem::path& samples_csv, const std::optional<std::string>& shard,
                      const std::function<void(const PlannedRow&)>& use);

/// Why a sample is not finished.
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
