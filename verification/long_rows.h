// Campaigns with a line each on the page: purpose, result, and whether it holds.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/config/config.h"

namespace tacipc::verify {

/// Description of a long row.
struct LongRow {
  std::string title, shows;
  std::string goal;                  // of make
  std::string stage;                 // whose record has holds and found in its summary
  std::string page;                  // relative to the page that shows the row
  std::optional<std::string> needs;  // a file of the shared data

  static LongRow read(ConfigReader& in);
};

/// configs/studies/verification/table/long_rows.yaml
struct LongRows {
  std::vector<LongRow> rows;

  static LongRows read(ConfigReader& in);
};

struct LongRowResult {
  LongRow row;
  std::string state;  // pass, missed, failed, skipped, not run
  std::string found;  // why, if it neither passed nor missed
};

/// Looks for the row's record, else its failure file, among `files`. A row with neither was skipped if the folder of
/// the shared data is not there. \throw DataError, ConfigError for a file that is not such a record
LongRowResult read_long_row(const LongRow& row, const std::vector<std::filesystem::path>& files,
                            const std::filesystem::path& shared);

/// The section of the page, a line for each row; empty without rows.
std::string long_rows_section(const std::vector<LongRowResult>& rows);

}  // namespace tacipc::verify
