// All results of a folder as one page: a table of rows, a line for each long row, and the plots beside it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "verification/judge.h"
#include "verification/long_rows.h"

namespace tacipc::verify {

/// One result.yaml as the page needs it.
struct ResultFile {
  std::string name;  // of its folder
  std::string title, source, state;
  std::optional<std::string> reason;
  std::optional<double> fitted_modulus_pa;
  int gel_vertices = 0;
  std::vector<Row> rows;
};

/// \throw DataError, ConfigError for a file that is not a result
ResultFile read_result(const std::filesystem::path& result_yaml);

/// The page in Markdown, its long rows as given. `plots` is the folder, relative to the page, with <name>.svg of every
/// case.
std::string to_markdown(const std::vector<ResultFile>& results, const std::vector<LongRowResult>& long_rows,
                        const std::string& plots);

}  // namespace tacipc::verify
