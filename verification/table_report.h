// All results of a folder as one page: a table of rows, a line for each campaign, and the plots.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/config/config.h"
#include "verification/judge.h"

namespace tacipc::verify {

/// Content of one result.yaml.
struct ResultFile {
  std::string name;  // name of its folder
  std::string title, source, state;
  std::optional<std::string> reason;
  std::optional<double> fitted_modulus_pa;
  int gel_vertices = 0;
  std::vector<Row> rows;
};

/// Reads a result.
/// \throw DataError, ConfigError for a file that is not a result
ResultFile read_result(const std::filesystem::path& result_yaml);

/// A campaign that has one line on the page: purpose, result, and whether it holds.
struct LongRow {
  std::string title, shows;
  std::string goal;                  // Make target
  std::string stage;                 // stage whose record has holds and found in its summary
  std::string page;                  // relative to the page that shows the row
  std::optional<std::string> needs;  // required file of the shared data

  static LongRow read(ConfigReader& in);
};

/// Content of configs/studies/verification/table/long_rows.yaml.
struct LongRows {
  std::vector<LongRow> rows;

  static LongRows read(ConfigReader& in);
};

/// State of a campaign.
struct LongRowResult {
  LongRow row;
  std::string state;  // pass, missed, failed, skipped, not run
  std::string found;  // result text; the reason if the state is neither pass nor missed
};

/// Looks for the row's record among `files`, otherwise for its failure file. A row without either is skipped if the
/// shared folder does not exist.
/// \throw DataError, ConfigError for a file that is not such a record
LongRowResult read_long_row(const LongRow& row, const std::vector<std::filesystem::path>& files,
                            const std::filesystem::path& shared);

/// Section of the page with one line for each row; empty without rows.
std::string long_rows_section(const std::vector<LongRowResult>& rows);

/// The page in Markdown; long rows keep their order.
/// \param plots folder, relative to the page, with <name>.svg of every case
std::string to_markdown(const std::vector<ResultFile>& results, const std::vector<LongRowResult>& long_rows,
                        const std::string& plots);

}  // namespace tacipc::verify
