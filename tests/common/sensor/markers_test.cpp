#include "common/sensor/markers.h"

#include <gtest/gtest.h>

#include <map>

#include "common/base/error.h"
#include "tests/scratch_folder.h"
#include "tests/stages/gel/press/measure/fronts.h"

namespace tacipc {
namespace markers_test {

TEST(Markers, LieOnTheirGridAtRest) {
  Positions rest;
  const FrontSurface front = square_front(23, 0.02, 0.35, rest);
  const MarkerGrid grid;
  const auto markers = bind_markers(grid, rest, front.triangles);
  ASSERT_EQ(markers.size(), 361u);
  const Positions at = marker_positions(markers, rest);
  for (std::size_t m = 0; m < markers.size(); ++m) {
    EXPECT_EQ(markers[m].row, static_cast<int>(m) / 19);
    EXPECT_EQ(markers[m].column, static_cast<int>(m) % 19);
    EXPECT_GE(markers[m].weights.minCoeff(), 0.0);
    EXPECT_NEAR(markers[m].weights.sum(), 1.0, 1e-15);
    EXPECT_NEAR(at(static_cast<Eigen::Index>(m), 0), grid.x_m(markers[m].column), 1e-17);
    EXPECT_NEAR(at(static_cast<Eigen::Index>(m), 1), grid.y_m(markers[m].row), 1e-17);
  }
}

TEST(Markers, FollowALinearMapExactly) {
  Positions rest;
  const FrontSurface front = square_front(23, 0.02, 0.35, rest);
  const auto markers = bind_markers(MarkerGrid{}, rest, front.triangles);
  const Matrix3 stretch{{1.1, 0.2, 0.0}, {-0.1, 0.9, 0.0}, {0.3, 0.1, 1.0}};
  const Positions moved = rest * stretch.transpose();
  EXPECT_LT((marker_positions(markers, moved) - marker_positions(markers, rest) * stretch.transpose()).norm(), 1e-16);
}

TEST(Markers, OnADomedFrontLieWithinTheSagOfATriangle) {
  Positions rest;
  const double radius_m = 0.03, cell_m = 0.02 / 40;
  const FrontSurface front = square_front(40, 0.02, 0.2, rest, radius_m);
  const auto markers = bind_markers(MarkerGrid{}, rest, front.triangles);
  ASSERT_EQ(markers.size(), 361u);
  const Positions at = marker_positions(markers, rest);
  for (Eigen::Index m = 0; m < at.rows(); ++m) {
    const double sphere_z = std::sqrt(radius_m * radius_m - at.row(m).head<2>().squaredNorm()) - radius_m;
    EXPECT_LE(at(m, 2), sphere_z + 1e-15);
    EXPECT_GE(at(m, 2), sphere_z - 2.0 * cell_m * cell_m / (2.0 * radius_m));
  }
}

TEST(Markers, OnVerticesAndEdgesAreFoundOnce) {
  // Cells of 1 mm with corners on the marker grid: each inner marker lies on a vertex of six triangles.
  Positions rest;
  const FrontSurface front = square_front(20, 0.02, 0.0, rest);
  const auto markers = bind_markers(MarkerGrid{}, rest, front.triangles);
  ASSERT_EQ(markers.size(), 361u);
  for (const Marker& marker : markers) EXPECT_NEAR(marker.weights.maxCoeff(), 1.0, 1e-12);
  // The same mesh with its triangles in another order: the same points, whatever triangle carries them.
  const Triangles reversed = front.triangles.colwise().reverse();
  const auto again = bind_markers(MarkerGrid{}, rest, reversed);
  EXPECT_LT((marker_positions(again, rest) - marker_positions(markers, rest)).norm(), 1e-15);
  // On the very border.
  const MarkerGrid border{.rows = 3, .columns = 3, .pitch_m = 0.01, .given = true};
  EXPECT_EQ(bind_markers(border, rest, front.triangles).size(), 9u);
}

TEST(Markers, OnVerticesAndEdgesBelongToTheFirstTriangleThere) {
  // All numbers are exact: cells of 1/4, markers on their corners, on the middles of their edges and diagonals.
  Positions rest;
  const FrontSurface front = square_front(8, 2.0, 0.0, rest);
  const MarkerGrid grid{.rows = 17, .columns = 17, .pitch_m = 0.125};
  const Triangles reversed = front.triangles.colwise().reverse();
  for (const Triangles& triangles : {front.triangles, reversed}) {
    const auto markers = bind_markers(grid, rest, triangles);
    ASSERT_EQ(markers.size(), 17u * 17u);
    for (const Marker& marker : markers) {
      const Eigen::Vector2d point(grid.x_m(marker.column), grid.y_m(marker.row));
      const auto holds = [&](Eigen::Index t) {
        bool inside = true;
        for (int k = 0; k < 3; ++k) {
          const Eigen::Vector2d a = rest.row(triangles(t, k)).head<2>(),
                                b = rest.row(triangles(t, (k + 1) % 3)).head<2>();
          inside = inside && (b - a).x() * (point - a).y() >= (b - a).y() * (point - a).x();
        }
        return inside;
      };
      Eigen::Index first = 0;
      while (!holds(first)) ++first;
      EXPECT_EQ(marker.vertices, (std::array<int, 3>{triangles(first, 0), triangles(first, 1), triangles(first, 2)}))
          << "row " << marker.row << ", column " << marker.column;
    }
  }
}

TEST(Markers, OfTrianglesAboveEachOtherTheOneTheyLieDeepestInCarriesThem) {
  const Positions rest{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}, {-3, -2, -1}, {3, -2, -1}, {0, 4, -1}};
  // The smallest weights at the origin are 1/4 and 1/3.
  for (const Triangles& triangles : {Triangles{{0, 1, 2}, {3, 4, 5}}, Triangles{{3, 4, 5}, {0, 1, 2}}}) {
    const auto markers = bind_markers({.rows = 1, .columns = 1}, rest, triangles);
    ASSERT_EQ(markers.size(), 1u);
    EXPECT_EQ(markers[0].vertices, (std::array<int, 3>{3, 4, 5}));
    EXPECT_LT((markers[0].weights - Vector3::Constant(1.0 / 3.0)).norm(), 1e-15);
  }
}

TEST(Markers, OffTheFrontAreNamedOrLeftOut) {
  Positions rest;
  const FrontSurface front = square_front(20, 0.016, 0.2, rest);
  MarkerGrid grid;
  EXPECT_EQ(bind_markers(grid, rest, front.triangles).size(), 17u * 17u);
  EXPECT_EQ(bind_markers(grid, rest, front.triangles).front().row, 1);
  grid.given = true;
  EXPECT_EQ(message_of<DataError>([&] { bind_markers(grid, rest, front.triangles); }),
            "marker in row 0, column 0 at (-9, -9) mm does not lie on the front face");
  grid = {.rows = 1, .columns = 2, .pitch_m = 0.004, .center_x_m = 0.0065, .given = true};
  EXPECT_EQ(message_of<DataError>([&] { bind_markers(grid, rest, front.triangles); }),
            "marker in row 0, column 1 at (8.5, 0) mm does not lie on the front face");
}

TEST(Markers, TrianglesThatDoNotLookUpCarryNone) {
  Positions rest{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}, {-1, -1, -1}, {1, -1, -1}, {0, 1, -1}};
  const MarkerGrid one{.rows = 1, .columns = 1};
  // The lower one looks down and comes first.
  const auto markers = bind_markers(one, rest, Triangles{{3, 5, 4}, {0, 1, 2}});
  ASSERT_EQ(markers.size(), 1u);
  EXPECT_EQ(markers[0].vertices, (std::array<int, 3>{0, 1, 2}));
  EXPECT_TRUE(bind_markers(one, rest, Triangles{{3, 5, 4}, {0, 1, 1}}).empty());
}

TEST(Markers, DisplacementsCountFromRestAndFromTheEndOfThePress) {
  const std::vector<Positions> frames{Positions{{0, 0, 0}, {1, 0, 0}}, Positions{{0, 0, -1}, {1, 0, -2}},
                                      Positions{{5, 0, -1}, {6, 3, -2}}};
  const std::vector<double> zero{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  auto wanted = zero;
  wanted.insert(wanted.end(), {0, 0, -1, 0, 0, 0, 0, 0, -2, 0, 0, 0});
  wanted.insert(wanted.end(), {5, 0, -1, 5, 0, 0, 5, 3, -2, 5, 3, 0});
  EXPECT_EQ(marker_displacements(frames, 1), wanted);
  const auto without = marker_displacements(frames, std::nullopt);
  for (std::size_t i = 0; i < without.size(); ++i) EXPECT_EQ(without[i], i % 6 < 3 ? wanted[i] : 0.0);
}

TEST(Markers, TableHoldsTheBinding) {
  const std::vector<Marker> markers{{.row = 0, .column = 1, .vertices = {4, 8, 9}, .weights = {0.1, 0.7, 0.2}}};
  EXPECT_EQ(markers_csv(markers),
            "marker,row,column,vertex0,vertex1,vertex2,weight0,weight1,weight2\n0,0,1,4,8,9,0.1,0.7,0.2\n");
}

}  // namespace markers_test
}  // namespace tacipc
