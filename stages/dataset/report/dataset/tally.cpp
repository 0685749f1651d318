#include "stages/dataset/report/dataset/tally.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tacipc {

void CostColumn::add(const StageTimings& cost) {
  wall_s.push_back(cost.wall_s);
  processor_s.push_back(cost.processor_s);
  memory_mb.push_back(cost.peak_memory_mb);
}

void DatasetTally::Words::add(const std::string& word) {
  of_sample.push_back(number.emplace(word, static_cast<std::uint32_t>(number.size())).first->second);
}

void DatasetTally::add(const SampleRow& row) {
  const PlannedRow& plan = row.plan;
  const std::pair<const char*, std::string> words[] = {{"split", plan.split},
                                                       {"pose split", plan.split_pose},
                                                       {"gel", gel_of(plan)},
                                                       {"object", plan.object},
                                                       {"motion", plan.motion}};
  const auto status = static_cast<std::size_t>(row.status);
  ++all.of[status];
  for (const auto& [column, word] : words) ++counts[column][word].of[status];
  if (!row.outcome.empty()) ++counts["outcome"][row.outcome].of[status];
  if (!row.reason.empty()) ++counts["reason"][row.reason].of[status];
  dropped += row.dropped ? 1 : 0;
  if (row.press) press.add(*row.press);
  if (row.render) render.add(*row.render);
  if (row.failure) {
    ++failures_by_kind[row.failure->stage + ": " +
                       (row.failure->check.empty() ? "no check of the verdict" : row.failure->check)];
    if (failures.size() < kept_failures_) failures.push_back({plan, *row.failure});
  }
  if (row.status != SampleStatus::made) return;
  for (const auto& [column, word] : words) words_[column].add(word);
  for (std::size_t q = 0; q < kQuantities.size(); ++q)
    numbers_[q].push_back((row.numbers.*kQuantities[q].number).value_or(std::numeric_limits<double>::quiet_NaN()));
  const SampleNumbers& numbers = row.numbers;
  worst_balance = std::max(worst_balance, numbers.balance_relative);
  const auto least = [](std::optional<double>& so_far, std::optional<double> value) {
    if (value) so_far = std::min(so_far.value_or(*value), *value);
  };
  least(smallest_distance_m, numbers.min_distance_m);
  least(smallest_volume_ratio, numbers.min_volume_ratio);
}

std::map<std::string, std::vector<double>> DatasetTally::values(std::size_t quantity, const std::string& column) const {
  std::map<std::string, std::vector<double>> values;
  const auto words = words_.find(column);
  if (words == words_.end()) return values;
  std::vector<std::vector<double>*> of_number(words->second.number.size());
  for (const auto& [word, number] : words->second.number) of_number[number] = &values[word];
  for (std::size_t i = 0; i < numbers_[quantity].size(); ++i) {
    if (const double value = numbers_[quantity][i]; !std::isnan(value))
      of_number[words->second.of_sample[i]]->push_back(value);
  }
  return values;
}

std::pair<std::vector<double>, std::vector<double>> DatasetTally::pairs(std::size_t first, std::size_t second) const {
  std::pair<std::vector<double>, std::vector<double>> pairs;
  for (std::size_t i = 0; i < numbers_[first].size(); ++i) {
    if (std::isnan(numbers_[first][i]) || std::isnan(numbers_[second][i])) continue;
    pairs.first.push_back(numbers_[first][i]);
    pairs.second.push_back(numbers_[second][i]);
  }
  return pairs;
}

}  // namespace tacipc
