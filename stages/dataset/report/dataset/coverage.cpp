#include "stages/dataset/report/dataset/coverage.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "common/base/statistics.h"

namespace tacipc {
namespace {

/// Cell that contains a value, among `cells` equal ones of [low, high]; the upper end belongs to the last cell.
int cell_of(double value, double low, double high, int cells) {
  return std::clamp(static_cast<int>(std::floor((value - low) / (high - low) * cells)), 0, cells - 1);
}

Axis axis_with_zero(const std::vector<double>& values, int max_ticks) {
  double low = 0.0, high = 0.0;
  for (const double value : values) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  return round_axis(low, high, max_ticks);
}

}  // namespace

std::optional<Spread> spread_of(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  const double sum = std::accumulate(values.begin(), values.end(), 0.0);
  return Spread{.count = values.size(),
                .mean = sum / static_cast<double>(values.size()),
                .sum = sum,
                .low = values.front(),
                .p5 = quantile(values, 0.05),
                .median = quantile(values, 0.5),
                .p95 = quantile(values, 0.95),
                .high = values.back()};
}

std::size_t Histogram::total(int bin) const {
  std::size_t sum = 0;
  for (const auto& group : counts) sum += group[static_cast<std::size_t>(bin)];
  return sum;
}

std::size_t Histogram::largest() const {
  std::size_t most = 0;
  for (int bin = 0; bin < num_bins(); ++bin) most = std::max(most, total(bin));
  return most;
}

Histogram histogram(const std::vector<std::vector<double>>& groups, int max_bins) {
  assert(max_bins >= 2);
  std::optional<double> low, high;
  for (const auto& group : groups) {
    for (const double value : group) {
      low = std::min(low.value_or(value), value);
      high = std::max(high.value_or(value), value);
    }
  }
  Histogram result{round_axis(low.value_or(0.0), high.value_or(0.0), max_bins + 1), {}};
  const int bins = result.num_bins();
  for (const auto& group : groups) {
    auto& counts = result.counts.emplace_back(static_cast<std::size_t>(bins), 0);
    // A value that misses an edge only by rounding counts as on it.
    const double slack = 1e-9 * result.bins.step;
    for (const double value : group)
      ++counts[static_cast<std::size_t>(cell_of(value + slack, result.bins.low, result.bins.high, bins))];
  }
  return result;
}

std::size_t PairMap::largest() const { return counts.empty() ? 0 : *std::max_element(counts.begin(), counts.end()); }

PairMap pair_map(const std::vector<double>& x, const std::vector<double>& y, int columns, int rows, int max_ticks) {
  assert(x.size() == y.size());
  PairMap map{axis_with_zero(x, max_ticks), axis_with_zero(y, max_ticks), columns, rows, {}};
  map.counts.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const int column = cell_of(x[i], map.x.low, map.x.high, columns), row = cell_of(y[i], map.y.low, map.y.high, rows);
    ++map.counts[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column)];
  }
  return map;
}

std::vector<std::size_t> evenly_chosen(std::size_t among, std::size_t count) {
  count = std::min(count, among);
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(i * among / count);
  return chosen;
}

}  // namespace tacipc
