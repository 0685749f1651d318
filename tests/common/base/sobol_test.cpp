#include "common/base/sobol.h"

#include <gtest/gtest.h>

#include <set>

namespace tacipc {
namespace sobol_test {

TEST(Sobol, FirstPointsByHand) {
  const double points[][3] = {
      {0, 0, 0}, {0.5, 0.5, 0.5}, {0.25, 0.75, 0.75}, {0.75, 0.25, 0.25}, {0.125, 0.625, 0.375}};
  for (std::uint32_t i = 0; i < 5; ++i)
    for (int d = 0; d < 3; ++d) EXPECT_EQ(sobol(i, d), points[i][d]) << "point " << i << ", dimension " << d;
}

TEST(Sobol, EachIntervalOfEachDimensionHasOnePoint) {
  for (int d = 0; d < kSobolDimensions; ++d)
    for (const std::uint32_t count : {8u, 64u, 1024u})
      for (const std::uint32_t start : {0u, count, 5 * count}) {
        std::set<int> intervals;
        for (std::uint32_t i = 0; i < count; ++i) intervals.insert(static_cast<int>(sobol(start + i, d) * count));
        EXPECT_EQ(intervals.size(), count) << "dimension " << d << ", points from " << start;
      }
}

// A square cell each of every pair of dimensions holds its share as soon as there are enough points: a pair whose
// polynomials were the same would leave most of them empty.
TEST(Sobol, NoTwoDimensionsAreAlike) {
  for (int a = 0; a < kSobolDimensions; ++a)
    for (int b = 0; b < a; ++b) {
      int cells[8][8] = {};
      for (std::uint32_t i = 0; i < 4096; ++i) ++cells[int(8 * sobol(i, a))][int(8 * sobol(i, b))];
      for (const auto& row : cells)
        for (const int count : row) EXPECT_EQ(count, 64) << "dimensions " << a << " and " << b;
    }
}

}  // namespace sobol_test
}  // namespace tacipc
