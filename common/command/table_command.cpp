#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>

#include "common/base/error.h"
#include "common/command/file_commands.h"
#include "common/format/csv.h"

namespace tacipc {
namespace {

/// Returns the index of a column.
/// \throw DataError, listing the columns there are
std::size_t column(const CsvReader& table, const std::string& file, const std::string& name) {
  const auto& names = table.columns();
  const auto found = std::ranges::find(names, name);
  if (found == names.end())
    throw DataError("{}: there is no column '{}'; it has {}", file, name, fmt::join(names, ", "));
  return static_cast<std::size_t>(found - names.begin());
}

/// Appends a field as one word of a line.
void append(std::string& line, const std::string& field) {
  for (const char c : field) line += c == '\t' || c == '\n' || c == '\r' ? ' ' : c;
}

}  // namespace

void print_table(const TableRequest& request) {
  CsvReader table(request.file);
  std::vector<std::size_t> shown;
  for (const std::string& name : request.columns.empty() ? table.columns() : request.columns)
    shown.push_back(column(table, request.file, name));
  std::vector<std::pair<std::size_t, std::string>> wanted;
  for (const std::string& condition : request.conditions) {
    const std::size_t equals = condition.find('=');
    if (equals == std::string::npos) throw UsageError(fmt::format("--where '{}': say COLUMN=VALUE", condition));
    wanted.emplace_back(column(table, request.file, condition.substr(0, equals)), condition.substr(equals + 1));
  }
  std::size_t count = 0;
  std::string line;
  while (table.next()) {
    const auto& row = table.row();
    if (!std::ranges::all_of(wanted, [&](const auto& w) { return row[w.first] == w.second; })) continue;
    ++count;
    if (request.only_count) continue;
    line.clear();
    for (const std::size_t i : shown) {
      append(line, row[i]);
      line += '\t';
    }
    line.back() = '\n';
    std::fwrite(line.data(), 1, line.size(), stdout);
  }
  if (request.only_count) fmt::print("{}\n", count);
}

}  // namespace tacipc
