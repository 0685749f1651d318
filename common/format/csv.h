// Reads and writes tables as CSV (RFC 4180) with a line of column names.
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tacipc {

/// Returns one line. Fields with a comma, a quote or a line break are quoted.
std::string csv_line(const std::vector<std::string>& fields);

/// Reads a table row by row, so that it need not fit into memory.
class CsvReader {
 public:
  /// Opens a table.
  /// \throw DataError if the file cannot be read or has no line of names
  explicit CsvReader(const std::filesystem::path& path);

  const std::vector<std::string>& columns() const { return columns_; }
  /// Moves to the next row; returns false after the last one.
  /// \throw DataError if a row does not have one field per column, or a quote is not terminated
  bool next();
  /// Returns a field of the current row.
  /// \throw DataError if the table has no such column
  const std::string& operator[](std::string_view column) const;
  /// Returns a field as a number, which may be inf or nan; leading blanks are ignored.
  /// \throw DataError `FILE:LINE: column: …` if it is not a number
  double number(std::string_view column) const;
  const std::vector<std::string>& row() const { return row_; }
  /// Returns the number of the line on which the current row ended.
  int line() const { return line_; }

 private:
  std::optional<std::vector<std::string>> read_row();

  std::string name_;
  std::ifstream file_;
  std::vector<std::string> columns_;
  std::vector<std::string> row_;
  int line_ = 0;
};

}  // namespace tacipc
