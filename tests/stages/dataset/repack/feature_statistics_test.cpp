// Statistics against sorted lists: quantiles, sums of episodes, numbers that do not count.
#include "stages/dataset/repack/feature_statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/base/rng.h"

namespace tacipc {
namespace feature_statistics_test {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// By the definition: the smallest of the sorted numbers that at least this part of all do not exceed.
double quantile_of(std::vector<double> numbers, double part) {
  std::sort(numbers.begin(), numbers.end());
  const auto rank = static_cast<std::size_t>(std::max(std::ceil(part * static_cast<double>(numbers.size())), 1.0));
  return numbers[rank - 1];
}

void expect_statistics_of(const std::vector<double>& numbers, const NumberStatistics& statistics) {
  const auto got = statistics.values();
  const auto count = static_cast<double>(numbers.size());
  double mean = 0.0, squares = 0.0;
  for (const double number : numbers) mean += number / count;
  for (const double number : numbers) squares += (number - mean) * (number - mean);
  const auto [least, greatest] = std::minmax_element(numbers.begin(), numbers.end());
  EXPECT_EQ(got[0], *least);
  EXPECT_EQ(got[1], *greatest);
  EXPECT_NEAR(got[2], mean, 1e-12 * (std::abs(*least) + std::abs(*greatest)));
  EXPECT_NEAR(got[3], std::sqrt(squares / count), 1e-12 * (*greatest - *least));
  const double parts[] = {0.01, 0.1, 0.5, 0.9, 0.99};
  for (std::size_t q = 0; q < 5; ++q) {
    const double wanted = quantile_of(numbers, parts[q]);
    EXPECT_NEAR(got[4 + q], wanted, std::ldexp(std::abs(wanted), -15)) << kStatistics[4 + q] << " of " << count;
  }
}

std::vector<double> drawn(std::size_t count, double scale, double shift) {
  std::vector<double> numbers;
  for (std::size_t i = 0; i < count; ++i)
    numbers.push_back(static_cast<float>(shift + scale * std::pow(random_uniform(7, count, i) - 0.3, 3.0)));
  return numbers;
}

TEST(NumberStatistics, AgreeWithSortedLists) {
  for (const std::size_t count : {1, 2, 6, 99, 100, 101, 5000}) {
    for (const auto& [scale, shift] : {std::pair{1.0, 0.0}, {1e-6, 0.0}, {300.0, -1000.0}, {1e-3, 12.0}}) {
      const std::vector<double> numbers = drawn(count, scale, shift);
      NumberStatistics statistics;
      for (const double number : numbers) statistics.add(number);
      expect_statistics_of(numbers, statistics);
    }
  }
}

TEST(NumberStatistics, OfPartsAddUp) {
  const std::vector<double> numbers = drawn(3000, 2.0, 0.1);
  NumberStatistics whole, parts;
  for (std::size_t begin = 0; begin < numbers.size(); begin += 700) {
    NumberStatistics part;
    for (std::size_t i = begin; i < std::min(begin + 700, numbers.size()); ++i) part.add(numbers[i]);
    parts.add(part);
  }
  parts.add(NumberStatistics());
  expect_statistics_of(numbers, parts);
}

TEST(NumberStatistics, TakeEachNumberAsOftenAsSaid) {
  NumberStatistics statistics;
  statistics.add(0.0, 98);
  statistics.add(-1.0, 1);
  statistics.add(2.0, 1);
  statistics.add(5.0, 0);
  expect_statistics_of(
      [] {
        std::vector<double> numbers(98, 0.0);
        numbers.insert(numbers.end(), {-1.0, 2.0});
        return numbers;
      }(),
      statistics);
}

TEST(NumberStatistics, WhatIsNotFiniteDoesNotCount) {
  NumberStatistics statistics;
  EXPECT_EQ(statistics.values(), (std::array<double, 9>{}));
  statistics.add(kNaN);
  statistics.add(std::numeric_limits<double>::infinity());
  EXPECT_EQ(statistics.values(), (std::array<double, 9>{}));
  statistics.add(-3.0);
  EXPECT_EQ(statistics.values(), (std::array<double, 9>{-3, -3, -3, 0, -3, -3, -3, -3, -3}));
}

TEST(FeatureStatistics, EachNumberHasItsOwnAndFramesAreCounted) {
  FeatureStatistics vectors(2), episode(2);
  vectors.add_frame(std::vector{1.0, -5.0});
  episode.add_frame(std::vector{3.0, kNaN});
  vectors.add(episode);
  EXPECT_EQ(vectors.frames(), 2);
  EXPECT_EQ(vectors.values()[0], (std::vector{1.0, -5.0}));
  EXPECT_EQ(vectors.values()[1], (std::vector{3.0, -5.0}));
  EXPECT_EQ(vectors.values()[6], (std::vector{1.0, -5.0}));  // q50
  FeatureStatistics field(1);
  field.add_frame(std::vector{1.0F, 2.0F, 3.0F, 6.0F});
  EXPECT_EQ(field.frames(), 1);
  EXPECT_EQ(field.values()[2], (std::vector{3.0}));
}

TEST(FeatureStatistics, CodesOfPicturesArePartsOf255) {
  FeatureStatistics picture(3);
  const std::vector<std::uint8_t> codes{0, 255, 51, 0, 0, 102, 255, 0, 153, 255, 255, 204};
  picture.add_frame(codes);
  EXPECT_EQ(picture.values()[0], (std::vector{0.0, 0.0, 0.2}));
  EXPECT_EQ(picture.values()[1], (std::vector{1.0, 1.0, 0.8}));
  EXPECT_EQ(picture.values()[2][0], 0.5);
  EXPECT_NEAR(picture.values()[2][2], 0.5, 1e-15);
  EXPECT_NEAR(picture.values()[6][2], 0.4, 1e-5);
}

}  // namespace feature_statistics_test
}  // namespace tacipc
