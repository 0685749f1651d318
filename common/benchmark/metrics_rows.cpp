#include "common/benchmark/metrics_rows.h"

#include <fmt/core.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "common/base/statistics.h"
#include "common/format/csv.h"

namespace tacipc {

double psnr_db(double mse) { return -10.0 * std::log10(mse); }

double MetricsRow::operator[](std::string_view column) const {
  const auto found = std::ranges::find_if(values, [&](const auto& value) { return value.first == column; });
  assert(found != values.end());
  return found->second;
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
  for (const char* region : {"full", "crop", "box", "pressed", "beside"}) {
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
