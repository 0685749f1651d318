// The order in which Gauss-Seidel sweeps take blocks.
#include <gtest/gtest.h>

#include "stages/gel/press/solve/sweep_order.h"
#include "tests/stages/gel/press/solve/block_matrices.h"

namespace tacipc {
namespace sweep_order_test {

TEST(SweepOrder, PartsShareNoBlockAndEveryBlockHasItsPlace) {
  const BlockPattern pattern = chain(1000);
  for (const int parts : {1, 2, 4}) {
    const SweepOrder order = make_sweep_order(pattern, parts);
    ASSERT_EQ(order.num_parts(), parts);
    EXPECT_EQ(order.num_rows(), 1000);
    EXPECT_TRUE(parts == 1 ? order.separator() == 1000 : order.separator() > 970 && order.separator() < 1000);
    std::vector<int> rows = order.row_of;
    std::sort(rows.begin(), rows.end());
    for (int r = 0; r < 1000; ++r) ASSERT_EQ(rows[r], r);
    const auto part_of = [&](int row) {
      return std::upper_bound(order.part_start.begin(), order.part_start.end(), row) - order.part_start.begin() - 1;
    };
    std::vector<int> seen(pattern.row.size(), 0);
    for (int c = 0; c < 1000; ++c) {
      for (int k = order.column_start[c]; k < order.column_start[c + 1]; ++k) {
        const int r = order.row[k];
        ASSERT_GT(r, c);
        EXPECT_EQ(r >= order.separator(), k >= order.separator_start[c]);
        EXPECT_TRUE(r >= order.separator() || part_of(r) == part_of(c));
        const bool turned = order.source[k] < 0;
        const int source = turned ? -1 - order.source[k] : order.source[k];
        ++seen[source];
        const auto column_of = std::upper_bound(pattern.column_start.begin(), pattern.column_start.end(), source) -
                               pattern.column_start.begin() - 1;
        const int i = order.row_of[pattern.row[source]], j = order.row_of[column_of];
        EXPECT_EQ(turned ? j : i, r);
        EXPECT_EQ(turned ? i : j, c);
      }
    }
    // All below the diagonal once, those on it never.
    for (int c = 0; c < 1000; ++c) {
      for (int k = pattern.column_start[c]; k < pattern.column_start[c + 1]; ++k)
        EXPECT_EQ(seen[k], k > pattern.column_start[c] ? 1 : 0);
    }
  }
}

TEST(SweepOrder, BodiesEndTheSeparatorAndDoNotBringWhatTouchesThemThere) {
  const int gel = 4000;
  for (const int bodies : {1, 2}) {
    const BlockPattern pattern = *matrix_with_bodies(gel, bodies, 1.0).pattern;
    for (const int parts : {1, 4}) {
      const SweepOrder order = make_sweep_order(pattern, parts), without = make_sweep_order(chain(gel), parts);
      EXPECT_EQ(order.separator(), without.separator()) << bodies << " bodies in " << parts << " parts";
      for (int r = 0; r < gel; ++r) ASSERT_EQ(order.row_of[r], without.row_of[r]);
      for (int r = gel; r < pattern.size(); ++r) EXPECT_EQ(order.row_of[r], r);
    }
  }
}

}  // namespace sweep_order_test
}  // namespace tacipc
