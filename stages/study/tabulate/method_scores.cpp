#include "stages/study/tabulate/method_scores.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "common/base/error.h"
#include "common/format/csv.h"

namespace tacipc {
namespace {

namespace fs = std::filesystem;

MeanDeviation mean_of(std::vector<double> values, bool geometric) {
  if (!geometric) return mean_and_deviation(values);
  for (double& value : values) value = std::log(value);
  const MeanDeviation logarithms = mean_and_deviation(values);
  return {.mean = std::exp(logarithms.mean), .deviation = std::exp(logarithms.deviation)};
}

std::vector<std::string> sorted(std::vector<std::string> names) {
  std::ranges::sort(names);
  return names;
}

MethodScores read_run(const fs::path& table, const MeasuredRow& row, const std::vector<ShownRegion>& regions,
                      const std::vector<ShownColumn>& columns, const std::set<std::string>& uncounted) {
  MethodScores scores{.row = row, .images = {}, .cells = {}};
  std::map<std::string, std::vector<std::string>> images;  // image names by region
  CsvReader csv(table);
  while (csv.next()) {
    const std::string& region = csv["region"];
    images[region].push_back(csv["name"]);
    for (const ShownColumn& shown : columns)
      scores.cells[{region, shown.column}].values.push_back(csv.number(shown.column));
  }
  for (const auto& [region, heading] : regions) {
    const auto names = sorted(images[region]);
    if (names.empty()) throw DataError("{}: has no row of region {}", table.string(), region);
    const auto twice = std::ranges::adjacent_find(names);
    if (twice != names.end()) throw DataError("{}: {} is there twice in region {}", table.string(), *twice, region);
    if (scores.images.empty()) scores.images = images[region];
    if (images[region] != scores.images)
      throw DataError("{}: region {} has other images than region {}", table.string(), region, regions.front().region);
    for (const ShownColumn& shown : columns) {
      auto& cell = scores.cells[{region, shown.column}];
      std::vector<double> counted;
      for (std::size_t i = 0; i < cell.values.size(); ++i)
        if (!uncounted.contains(fs::path(scores.images[i]).stem().string())) counted.push_back(cell.values[i]);
      if (counted.empty()) throw DataError("{}: none of its images counts", table.string());
      static_cast<MeanDeviation&>(cell) = mean_of(counted, shown.geometric);
      scores.counted = counted.size();
    }
  }
  return scores;
}

/// Means over the images for each run, and over the runs for each image.
MethodScores read_method(const std::vector<fs::path>& tables, const MeasuredRow& row,
                         const std::vector<ShownRegion>& regions, const std::vector<ShownColumn>& columns,
                         const std::set<std::string>& uncounted) {
  MethodScores scores = read_run(tables.front(), row, regions, columns, uncounted);
  if (tables.size() == 1) return scores;
  scores.runs = tables.size();
  std::vector<MethodScores> runs{scores};
  for (std::size_t run = 1; run < tables.size(); ++run) {
    runs.push_back(read_run(tables[run], row, regions, columns, uncounted));
    if (runs.back().images != scores.images)
      throw DataError("{}: has other images, or another order of them, than {}", tables[run].string(),
                      tables.front().string());
  }
  const auto over_runs = [&](const auto& value, bool geometric) {
    std::vector<double> values;
    for (const MethodScores& run : runs) values.push_back(value(run));
    return mean_of(values, geometric);
  };
  for (const auto& [region, heading] : regions)
    for (const ShownColumn& shown : columns) {
      const auto key = std::pair{region, shown.column};
      auto& cell = scores.cells[key];
      static_cast<MeanDeviation&>(cell) =
          over_runs([&](const MethodScores& run) { return run.cells.at(key).mean; }, shown.geometric);
      for (std::size_t i = 0; i < cell.values.size(); ++i)
        cell.values[i] =
            over_runs([&](const MethodScores& run) { return run.cells.at(key).values[i]; }, shown.geometric).mean;
    }
  return scores;
}

/// Images in one of two lists but not in the other, for a message.
std::string difference(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  std::vector<std::string> only;
  std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(only));
  return only.front();
}

}  // namespace

std::vector<MethodScores> read_methods(const std::vector<NamedPath>& tables, const std::vector<MeasuredRow>& rows,
                                       const std::vector<ShownRegion>& regions, const std::vector<ShownColumn>& columns,
                                       const std::set<std::string>& uncounted) {
  std::map<std::string, std::vector<fs::path>> by_method;
  for (const NamedPath& table : tables) {
    auto& runs = by_method[table.name];
    const auto same = [&](const fs::path& run) { return run.lexically_normal() == table.path.lexically_normal(); };
    if (std::ranges::any_of(runs, same)) throw DataError("{}: is given twice for {}", table.path.string(), table.name);
    runs.push_back(table.path);
  }
  std::vector<MethodScores> methods;
  for (const MeasuredRow& row : rows) {
    const auto place = by_method.find(row.method);
    if (place == by_method.end()) throw DataError("row '{}': no table was given for {}", row.name, row.method);
    methods.push_back(read_method(place->second, row, regions, columns, uncounted));
    const auto first = sorted(methods.front().images), these = sorted(methods.back().images);
    if (these != first)
      throw DataError("{}: was measured on other images than the first row; {} is only in one of them",
                      place->second.front().string(), difference(these, first));
    by_method.erase(place);
  }
  if (!by_method.empty())
    throw DataError("{}: no row of the configuration has the method {}", by_method.begin()->second.front().string(),
                    by_method.begin()->first);
  return methods;
}

}  // namespace tacipc
