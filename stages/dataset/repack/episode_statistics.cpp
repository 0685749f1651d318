#include "stages/dataset/repack/episode_statistics.h"

#include <fmt/core.h>

namespace tacipc {

void EpisodeStatistics::end_episode(const FeatureStatistics& episode) {
  const auto values = episode.values();
  for (std::size_t s = 0; s < values.size(); ++s)
    columns_[s].insert(columns_[s].end(), values[s].begin(), values[s].end());
  counts_.push_back(episode.frames());
  total_.add(episode);
}

void EpisodeStatistics::append_columns(std::vector<ParquetColumn>& columns, std::vector<ParquetValues>& values) const {
  const auto name_of = [&](const char* statistic) { return fmt::format("stats/{}/{}", name_, statistic); };
  std::vector<std::size_t> shape{total_.width()};
  if (image_) shape.insert(shape.end(), {1, 1});
  for (std::size_t s = 0; s < columns_.size(); ++s) {
    columns.push_back({.name = name_of(kStatistics[s]), .type = ParquetType::f64, .shape = shape});
    values.emplace_back(columns_[s]);
  }
  columns.push_back({.name = name_of("count"), .type = ParquetType::i64, .shape = {1}});
  values.emplace_back(counts_);
}

std::pair<std::string, Value> EpisodeStatistics::lines() const {
  Value::Map lines;
  const auto values = total_.values();
  for (std::size_t s = 0; s < values.size(); ++s) {
    Value::List numbers;
    for (const double number : values[s]) {
      if (image_)
        numbers.emplace_back(Value::List{Value(Value::List{Value(number)})});
      else
        numbers.emplace_back(number);
    }
    lines.emplace_back(kStatistics[s], std::move(numbers));
  }
  lines.emplace_back("count", Value::List{Value(total_.frames())});
  return {name_, std::move(lines)};
}

}  // namespace tacipc
