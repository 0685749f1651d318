#include "stages/rival/mpm/object_points.h"

#include <gtest/gtest.h>

#include "common/base/error.h"
#include "tests/make_mesh.h"

namespace tacipc {
namespace object_points_test {

/// A rectangle of 3 × 1 in the plane z = 2, cut into two triangles.
TriangleMesh rectangle() { return make_mesh({{0, 0, 2}, {3, 0, 2}, {3, 1, 2}, {0, 1, 2}}, {{0, 1, 2}, {0, 2, 3}}); }

TEST(SampleSurface, SpreadsEvenlyOverTheArea) {
  EXPECT_DOUBLE_EQ(surface_area(rectangle()), 3.0);
  const Positions points = sample_surface(rectangle(), 6000, 1);
  EXPECT_LT((points.col(2).array() - 2.0).abs().maxCoeff(), 1e-14);
  int cells[6][2] = {};
  for (Eigen::Index p = 0; p < points.rows(); ++p) {
    ASSERT_TRUE(points(p, 0) >= 0.0 && points(p, 0) <= 3.0 && points(p, 1) >= 0.0 && points(p, 1) <= 1.0);
    ++cells[std::min(5, static_cast<int>(2.0 * points(p, 0)))][std::min(1, static_cast<int>(2.0 * points(p, 1)))];
  }
  for (const auto& column : cells)
    for (const int count : column) EXPECT_NEAR(count, 500, 75);
}

TEST(SampleSurface, DependsOnTheSeedAlone) {
  EXPECT_EQ(sample_surface(rectangle(), 50, 1), sample_surface(rectangle(), 50, 1));
  EXPECT_NE(sample_surface(rectangle(), 50, 1), sample_surface(rectangle(), 50, 2));
}

TEST(SampleSurface, NeedsAnArea) {
  EXPECT_THROW(sample_surface(make_mesh({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}), 5, 1), DataError);
}

}  // namespace object_points_test
}  // namespace tacipc
