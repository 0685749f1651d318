#include "stages/study/metrics/metrics_table.h"

#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <exception>
#include <optional>

#include "common/base/statistics.h"
#include "common/format/csv.h"
#include "stages/study/metrics/image_error.h"

namespace tacipc {

double MetricsRow::operator[](std::string_view column) const {
  const auto found =
      std::find_if(values.begin(), values.end(), [&](const auto& value) { return value.first == column; });
  assert(found != values.end());
  return found->second;
}

std::vector<MetricsRow> measure_pairs(const std::vector<ImagePair>& pairs,
                                      const std::function<std::vector<MetricsRow>(const ImagePair&)>& measure) {
  std::vector<std::vector<MetricsRow>> of_pair(pairs.size());
  std::vector<std::exception_ptr> failed(pairs.size());
  tbb::parallel_for(std::size_t{0}, pairs.size(), [&](std::size_t i) {
    try {
      of_pair[i] = measure(pairs[i]);
    } catch (...) {
      failed[i] = std::current_exception();
    }
  });
  // The first failure in the order of the pairs, whichever thread was first.
  for (const std::exception_ptr& failure : failed)
    if (failure) std::rethrow_exception(failure);
  std::vector<MetricsRow> rows;
  for (const auto& some : of_pair) rows.insert(rows.end(), some.begin(), some.end());
  return rows;
}

std::string to_csv(const std::vector<MetricsRow>& rows) {
  std::vector<std::string> header{"name", "region"};
  for (const auto& [column, value] : rows.front().values) header.emplace_back(column);
  std::string text = csv_line(header);
  for (const MetricsRow& row : rows) {
    std::vector<std::string> fields{row.name, row.region};
    for (const auto& [column, value] : row.values) fields.push_back(fmt::format("{}", value));
    text += csv_line(fields);
  }
  return text;
}

Value::Map summary_of(const std::vector<MetricsRow>& rows) {
  Value::Map summary;
  for (const char* region : {"full", "crop", "box", "pressed"}) {
    std::vector<const MetricsRow*> some;
    for (const MetricsRow& row : rows)
      if (row.region == region) some.push_back(&row);
    if (some.empty()) continue;
    Value::Map lines{{"images", some.size()}};
    std::optional<double> mean_mse;
    for (const auto& [column, first] : some.front()->values) {
      std::vector<double> values;
      for (const MetricsRow* row : some) values.push_back((*row)[column]);
      const MeanDeviation value = mean_and_deviation(values);
      lines.emplace_back(column, Value::Map{{"mean", value.mean}, {"std", value.deviation}});
      if (column == std::string_view("mse")) mean_mse = value.mean;
    }
    if (mean_mse) lines.emplace_back("psnr_db_of_mean_mse", psnr_db(*mean_mse));
    summary.emplace_back(region, std::move(lines));
  }
  return summary;
}

}  // namespace tacipc
