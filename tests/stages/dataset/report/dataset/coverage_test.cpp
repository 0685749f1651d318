#include "stages/dataset/report/dataset/coverage.h"

#include <gmock/gmock.h>

#include <numeric>

namespace tacipc {
namespace coverage_test {

using ::testing::Each;
using ::testing::ElementsAre;

TEST(Spread, IsThatOfTheSortedValues) {
  const auto spread = spread_of({5, 1, 3, 2, 4});
  ASSERT_TRUE(spread);
  EXPECT_EQ(spread->count, 5u);
  EXPECT_EQ(spread->sum, 15);
  EXPECT_EQ(spread->mean, 3);
  EXPECT_EQ(spread->low, 1);
  EXPECT_EQ(spread->median, 3);
  EXPECT_EQ(spread->high, 5);
  EXPECT_DOUBLE_EQ(spread->p5, 1.2);
  EXPECT_DOUBLE_EQ(spread->p95, 4.8);
  EXPECT_FALSE(spread_of({}));
}

TEST(Histogram, CountsEachValueOnceAndEdgesUpwards) {
  // 0.1 · 3 is a little more than 0.3, 0.1 · 6 a little more than 0.6: both stand for the edge.
  std::vector<double> values;
  for (int i = 0; i <= 10; ++i) values.push_back(0.1 * i);
  const Histogram h = histogram({values}, 10);
  ASSERT_EQ(h.num_bins(), 10);
  EXPECT_DOUBLE_EQ(h.bins.tick(1), 0.1);
  EXPECT_THAT(h.counts[0], ElementsAre(1, 1, 1, 1, 1, 1, 1, 1, 1, 2));  // the last bin has both of its ends
}

TEST(Histogram, HasRoundBinsOfAllGroupsTogether) {
  const Histogram h = histogram({{0.42, 0.55}, {0.71}, {}}, 8);
  EXPECT_LE(h.num_bins(), 8);
  EXPECT_LE(h.bins.low, 0.42);
  EXPECT_GE(h.bins.high, 0.71);
  ASSERT_EQ(h.counts.size(), 3u);
  std::size_t all = 0;
  for (int bin = 0; bin < h.num_bins(); ++bin) all += h.total(bin);
  EXPECT_EQ(all, 3u);
  EXPECT_THAT(h.counts[2], Each(0u));
  EXPECT_EQ(h.largest(), 1u);
}

TEST(Histogram, EqualAndNegativeValuesHaveTheirBin) {
  const Histogram equal = histogram({{3, 3, 3}}, 20);
  EXPECT_EQ(equal.largest(), 3u);
  const Histogram around_zero = histogram({{-10, 0, 10}}, 20);
  EXPECT_EQ(std::accumulate(around_zero.counts[0].begin(), around_zero.counts[0].end(), 0u), 3u);
  EXPECT_EQ(around_zero.bins.low, -10);
  EXPECT_EQ(histogram({{}}, 5).largest(), 0u);
}

TEST(PairMap, CountsPairsInCellsFromTheLowerLeft) {
  const PairMap map = pair_map({0, 10, 10, 5}, {0, 1, 1, 0.5}, 2, 4, 7);
  EXPECT_EQ(map.x.low, 0);
  EXPECT_EQ(map.x.high, 10);
  EXPECT_EQ(map.y.high, 1);
  ASSERT_EQ(map.counts.size(), 8u);
  EXPECT_EQ(map.counts[0], 1u);          // (0, 0)
  EXPECT_EQ(map.counts[2 * 2 + 1], 1u);  // (5, 0.5) opens the second column and the third row
  EXPECT_EQ(map.counts[3 * 2 + 1], 2u);  // the upper right corner is inside
  EXPECT_EQ(map.largest(), 2u);
}

TEST(EvenlyChosen, AreApartByTheSameOrOneMore) {
  EXPECT_THAT(evenly_chosen(3, 10), ElementsAre(0, 1, 2));
  EXPECT_THAT(evenly_chosen(10, 0), ElementsAre());
  EXPECT_THAT(evenly_chosen(0, 5), ElementsAre());
  const auto chosen = evenly_chosen(1000, 300);
  ASSERT_EQ(chosen.size(), 300u);
  EXPECT_EQ(chosen.front(), 0u);
  for (std::size_t i = 1; i < chosen.size(); ++i) {
    EXPECT_GE(chosen[i] - chosen[i - 1], 3u);
    EXPECT_LE(chosen[i] - chosen[i - 1], 4u);
  }
}

}  // namespace coverage_test
}  // namespace tacipc
