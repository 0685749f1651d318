#include "stages/gel/press/measure/front_surface.h"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/stages/gel/press/measure/fronts.h"

namespace tacipc {
namespace front_surface_test {

TEST(FrontSurface, IsNumberedByItself) {
  // Two tetrahedra; the two faces that hold vertex 0 but not 2 are the front.
  TetMesh gel;
  gel.positions = Positions{{0, 0, 0}, {9, 9, 9}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  gel.boundary = Triangles{{0, 4, 3}, {0, 2, 4}, {2, 3, 4}, {4, 3, 0}};
  gel.tags = {BoundaryTag::front, BoundaryTag::side, BoundaryTag::glued, BoundaryTag::front};
  const FrontSurface front = make_front_surface(gel);
  EXPECT_EQ(front.vertices, (std::vector<int>{0, 3, 4}));
  EXPECT_EQ(front.triangles, (Triangles{{0, 2, 1}, {2, 1, 0}}));
  EXPECT_EQ(on_front(front, gel.positions), (Positions{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
}

TEST(FrontSurface, MedianEdgeIsTheFrontsAlone) {
  TetMesh gel;
  gel.positions = Positions{{0, 0, 0}, {3, 0, 0}, {0, 4, 0}, {0, 0, -100}};
  gel.boundary = Triangles{{0, 1, 2}, {0, 2, 3}};
  gel.tags = {BoundaryTag::front, BoundaryTag::side};
  EXPECT_EQ(median_front_edge_m(gel), 4.0) << "of 3, 4 and 5";
}

TEST(FrontSurface, LumpedAreasSumToTheFront) {
  Positions positions;
  const FrontSurface front = square_front(7, 0.01, 0.3, positions);
  const auto lumped = lumped_areas(front, positions);
  const auto areas = triangle_areas(front, positions);
  EXPECT_NEAR(std::accumulate(lumped.begin(), lumped.end(), 0.0), 1e-4, 1e-18);
  EXPECT_NEAR(std::accumulate(areas.begin(), areas.end(), 0.0), 1e-4, 1e-18);
  // A corner that only one triangle has, and the one that two have.
  EXPECT_DOUBLE_EQ(lumped[7], areas[12] / 3.0);
  EXPECT_DOUBLE_EQ(lumped[0], (areas[0] + areas[1]) / 3.0);
}

}  // namespace front_surface_test
}  // namespace tacipc
