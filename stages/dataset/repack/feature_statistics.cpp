#include "stages/dataset/repack/feature_statistics.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace tacipc {
namespace {

constexpr std::array kQuantiles{0.01, 0.10, 0.50, 0.90, 0.99};
constexpr std::uint32_t kSign = 0x80000000U;
constexpr int kDropped = 8;  // dropped bits of the mantissa

/// Key that ascends with the number.
std::uint32_t key_of(double number) {
  const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(number + 0.0));  // −0 becomes 0
  const std::uint32_t kept = bits >> kDropped << kDropped;
  return kept & kSign ? ~kept : kept | kSign;
}

/// Number nearest to 0 with this key.
double number_of(std::uint32_t key) {
  return static_cast<double>(std::bit_cast<float>(key & kSign ? key ^ kSign : ~key));
}

}  // namespace

void NumberStatistics::add(double number, std::int64_t times) {
  if (!std::isfinite(number) || times == 0) return;
  least_ = std::min(least_, number);
  greatest_ = std::max(greatest_, number);
  count_ += times;
  const double before = number - mean_;
  mean_ += before * static_cast<double>(times) / static_cast<double>(count_);
  squares_ += static_cast<double>(times) * before * (number - mean_);
  counts_[key_of(number)] += times;
}

void NumberStatistics::add(const NumberStatistics& other) {
  if (other.count_ == 0) return;
  least_ = std::min(least_, other.least_);
  greatest_ = std::max(greatest_, other.greatest_);
  const auto mine = static_cast<double>(count_), theirs = static_cast<double>(other.count_);
  const double apart = other.mean_ - mean_;
  mean_ += apart * theirs / (mine + theirs);
  squares_ += other.squares_ + apart * apart * mine * theirs / (mine + theirs);
  count_ += other.count_;
  for (const auto& [key, times] : other.counts_) counts_[key] += times;
}

std::array<double, 5> NumberStatistics::quantiles() const {
  std::vector<std::pair<std::uint32_t, std::int64_t>> sorted(counts_.begin(), counts_.end());
  std::sort(sorted.begin(), sorted.end());
  std::array<double, 5> numbers{};
  std::size_t at = 0;
  std::int64_t up_to = sorted.front().second;
  for (std::size_t q = 0; q < kQuantiles.size(); ++q) {
    while (static_cast<double>(up_to) < kQuantiles[q] * static_cast<double>(count_) && at + 1 < sorted.size())
      up_to += sorted[++at].second;
    numbers[q] = std::clamp(number_of(sorted[at].first), least_, greatest_);
  }
  return numbers;
}

std::array<double, kStatistics.size()> NumberStatistics::values() const {
  if (count_ == 0) return {};
  std::array<double, kStatistics.size()> all{least_, greatest_, mean_,
                                             std::sqrt(squares_ / static_cast<double>(count_))};
  std::ranges::copy(quantiles(), all.begin() + 4);
  return all;
}

void FeatureStatistics::add_frame(std::span<const double> values) {
  for (std::size_t i = 0; i < values.size(); ++i) of_[i % of_.size()].add(values[i]);
  ++frames_;
}

void FeatureStatistics::add_frame(std::span<const float> values) {
  for (std::size_t i = 0; i < values.size(); ++i) of_[i % of_.size()].add(static_cast<double>(values[i]));
  ++frames_;
}

void FeatureStatistics::add_frame(std::span<const std::uint8_t> codes) {
  constexpr std::size_t kCodes = 256;
  std::vector<std::int64_t> times(kCodes * of_.size(), 0);
  for (std::size_t i = 0; i < codes.size(); ++i) ++times[kCodes * (i % of_.size()) + codes[i]];
  for (std::size_t i = 0; i < times.size(); ++i) of_[i / kCodes].add(static_cast<double>(i % kCodes) / 255.0, times[i]);
  ++frames_;
}

void FeatureStatistics::add(const FeatureStatistics& other) {
  for (std::size_t i = 0; i < of_.size(); ++i) of_[i].add(other.of_[i]);
  frames_ += other.frames_;
}

std::array<std::vector<double>, kStatistics.size()> FeatureStatistics::values() const {
  std::array<std::vector<double>, kStatistics.size()> all;
  for (const NumberStatistics& one : of_) {
    const auto values = one.values();
    for (std::size_t s = 0; s < all.size(); ++s) all[s].push_back(values[s]);
  }
  return all;
}

}  // namespace tacipc
