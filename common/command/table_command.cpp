#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>

#include "common/base/error.h"
#include "common/command/command_run.h"
#include "common/command/file_commands.h"
#include "common/format/csv.h"

namespace tacipc {
namespace {

/// Index of a column. \throw DataError with the columns there are
std::size_t column(const CsvReader& table, const std::string& file, const std::string& name) {
  const auto& names = table.columns();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw DataError("{}: there is no column '{}'; it has {}", file, name, fmt::join(names, ", "));
  return static_cast<std::size_t>(found - names.begin());
}

/// A field as one word of a line.
void append(std::string& line, const std::string& field) {
  for (const char c : field) line += c == '\t' || c == '\n' || c == '\r' ? ' ' : c;
}

}  // namespace

int table_command(const std::vector<std::string>& arguments) {
  CLI::App app(
      "Prints rows of a table (CSV), fields separated by tabs; a tab or line break in a field becomes a blank.");
  std::string file, names;
  std::vector<std::string> conditions;
  bool only_count = false;
  app.add_option("file", file, "the table")->required()->type_name("FILE.csv");
  app.add_option("--columns", names, "columns to print, in this order, joined by commas (default: all)")
      ->type_name("NAMES");
  app.add_option("--where", conditions, "only rows with this value; may be given several times")
      ->expected(1)
      ->take_all()
      ->type_name("COLUMN=VALUE");
  app.add_flag("--count", only_count, "how many rows there are, instead of the rows");
  return run_command("table", app, arguments, [&] {
    CsvReader table(file);
    std::vector<std::size_t> shown;
    for (const std::string& name : names.empty() ? table.columns() : names_of(names))
      shown.push_back(column(table, file, name));
    std::vector<std::pair<std::size_t, std::string>> wanted;
    for (const std::string& condition : conditions) {
      const std::size_t equals = condition.find('=');
      if (equals == std::string::npos) throw UsageError(fmt::format("--where '{}': say COLUMN=VALUE", condition));
      wanted.emplace_back(column(table, file, condition.substr(0, equals)), condition.substr(equals + 1));
    }
    std::size_t count = 0;
    std::string line;
    while (table.next()) {
      const auto& row = table.row();
      if (!std::all_of(wanted.begin(), wanted.end(), [&](const auto& w) { return row[w.first] == w.second; })) continue;
      ++count;
      if (only_count) continue;
      line.clear();
      for (const std::size_t i : shown) {
        append(line, row[i]);
        line += '\t';
      }
      line.back() = '\n';
      std::fwrite(line.data(), 1, line.size(), stdout);
    }
    if (only_count) fmt::print("{}\n", count);
  });
}

}  // namespace tacipc
