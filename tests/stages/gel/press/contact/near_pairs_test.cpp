// The coarse distances against the exact ones.
#include "stages/gel/press/contact/near_pairs.h"

#include <gtest/gtest.h>

#include <random>

namespace tacipc {
namespace near_pairs_test {

using Kind = ContactPair::Kind;

/// Both kinds over random points, some on a coarse lattice so that points, edges and planes coincide or run parallel.
struct ManyPairs {
  Positions x;
  std::vector<ContactPair> pairs;

  ManyPairs() : x(4 * 3001, 3) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    std::uniform_int_distribution<int> lattice(0, 2);
    for (int i = 0; i < 3001; ++i) {
      for (int k = 0; k < 4; ++k) {
        for (int c = 0; c < 3; ++c) x(4 * i + k, c) = 1e-3 * (i % 3 == 0 ? 0.5 * lattice(random) : uniform(random));
      }
      if (i % 3 == 2) x.row(4 * i + 3) = x.row(4 * i + 2);  // a cell counted as a triangle (pair_counting.h)
      const Kind kind = i % 3 != 2 && i % 16 < 7 ? Kind::edge_edge : Kind::point_triangle;
      pairs.push_back({kind, {4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3}});
    }
  }
};

TEST(NearPairs, CoarseDistancesAreNeverTooLargeAndMostlyRight) {
  const ManyPairs many;
  const std::vector<double> found = coarse_squared_distances(many.pairs, many.x);
  int right = 0;
  for (std::size_t i = 0; i < many.pairs.size(); ++i) {
    const double exact = closest_feature(many.pairs[i], gather(many.x, many.pairs[i])).squared_distance;
    EXPECT_LE(found[i], (1 + 1e-7) * exact + 1e-30) << i;
    right += found[i] > 0.999999 * exact - 1e-30 ? 1 : 0;
  }
  EXPECT_GT(right, 0.9 * static_cast<double>(many.pairs.size()));
}

TEST(NearPairs, NoneIsMissed) {
  const ManyPairs many;
  for (const double reach : {0.05e-3, 0.2e-3, 0.5e-3}) {
    const std::vector<int> found = near_pairs(many.pairs, many.x, reach * reach);
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
    std::size_t near = 0;
    for (int i = 0; i < static_cast<int>(many.pairs.size()); ++i) {
      if (closest_feature(many.pairs[i], gather(many.x, many.pairs[i])).squared_distance >= reach * reach) continue;
      ++near;
      EXPECT_TRUE(std::binary_search(found.begin(), found.end(), i)) << i;
    }
    EXPECT_GT(near, 100u);
    EXPECT_LT(found.size(), 1.3 * static_cast<double>(near));
  }
}

}  // namespace near_pairs_test
}  // namespace tacipc
