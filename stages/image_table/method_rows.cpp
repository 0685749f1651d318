#include "stages/image_table/method_rows.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>

#include "common/csv.h"
#include "common/error.h"

namespace tacipc {
namespace {

namespace fs = std::filesystem;

std::string folder_of(const fs::path& table) { return fs::absolute(table).parent_path().filename().string(); }

MeanDeviation cell_of(std::vector<double> values, const ShownColumn& column) {
  if (!column.geometric) return mean_and_deviation(values);
  for (double& value : values) value = std::log(value);
  const MeanDeviation logarithms = mean_and_deviation(values);
  return {.mean = std::exp(logarithms.mean), .deviation = std::exp(logarithms.deviation)};
}

MethodRow read_row(const fs::path& table, const MeasuredRow& row, const ImageTableConfig& config) {
  std::map<std::string, std::vector<std::string>> images;  // by region
  std::map<std::pair<std::string, std::string>, std::vector<double>> values;
  CsvReader csv(table);
  while (csv.next()) {
    const std::string region = csv["region"];
    images[region].push_back(csv["name"]);
    for (const ShownColumn& shown : config.columns) {
      const std::string& text = csv[shown.column];
      char* end = nullptr;
      const double number = std::strtod(text.c_str(), &end);
      if (text.empty() || *end != '\0')
        throw DataError("{}:{}: {}: '{}' is no number", table.string(), csv.line(), shown.column, text);
      values[{region, shown.column}].push_back(number);
    }
  }
  MethodRow out{.row = row, .images = {}, .cells = {}};
  for (const ShownRegion& shown : config.regions) {
    auto& names = images[shown.region];
    if (names.empty()) throw DataError("{}: has no row of region {}", table.string(), shown.region);
    std::sort(names.begin(), names.end());
    if (std::adjacent_find(names.begin(), names.end()) != names.end())
      throw DataError("{}: {} is there twice in region {}", table.string(),
                      *std::adjacent_find(names.begin(), names.end()), shown.region);
    if (out.images.empty()) out.images = names;
    if (names != out.images)
      throw DataError("{}: region {} has other images than region {}", table.string(), shown.region,
                      config.regions.front().region);
    for (const ShownColumn& column : config.columns)
      out.cells[{shown.region, column.column}] = cell_of(values.at({shown.region, column.column}), column);
  }
  return out;
}

/// Which images one of two lists has and the other has not, for a message.
std::string difference(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  std::vector<std::string> only;
  std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(only));
  return only.front();
}

}  // namespace

std::vector<MethodRow> read_method_rows(const std::vector<fs::path>& tables, const ImageTableConfig& config) {
  std::map<std::string, fs::path> by_folder;
  for (const fs::path& table : tables) {
    const auto [place, fresh] = by_folder.emplace(folder_of(table), table);
    if (!fresh) throw DataError("{} and {}: lie in folders of the same name", place->second.string(), table.string());
  }
  std::vector<MethodRow> rows;
  for (const MeasuredRow& row : config.rows) {
    const auto place = by_folder.find(row.folder);
    if (place == by_folder.end())
      throw DataError("row '{}': none of the tables given lies in a folder named {}", row.name, row.folder);
    rows.push_back(read_row(place->second, row, config));
    if (rows.back().images != rows.front().images)
      throw DataError("{}: was measured on other images than the first row; {} is only in one of them",
                      place->second.string(), difference(rows.back().images, rows.front().images));
    by_folder.erase(place);
  }
  if (!by_folder.empty())
    throw DataError("{}: no row of the configuration names its folder, {}", by_folder.begin()->second.string(),
                    by_folder.begin()->first);
  return rows;
}

}  // namespace tacipc
