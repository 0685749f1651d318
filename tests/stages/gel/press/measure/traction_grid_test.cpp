#include "stages/gel/press/measure/traction_grid.h"

#include <gtest/gtest.h>

#include "tests/stages/gel/press/measure/fronts.h"

namespace tacipc {
namespace traction_grid_test {

const TractionGrid kGrid{.rows = 24, .columns = 32, .width_m = 0.015, .height_m = 0.01125};

/// Forces of a pressure p on each vertex, along −z.
Positions pressed(const FrontSurface& front, const Positions& positions, double pascal) {
  const auto lumped = lumped_areas(front, positions);
  Positions force = Positions::Zero(positions.rows(), 3);
  for (std::size_t v = 0; v < lumped.size(); ++v) force(static_cast<Eigen::Index>(v), 2) = -pascal * lumped[v];
  return force;
}

Vector3 sum_of_cells(const TractionGrid& grid, const std::vector<double>& traction, int kind) {
  Vector3 sum = Vector3::Zero();
  for (std::size_t cell = 0; cell < traction.size() / 6; ++cell)
    for (int i = 0; i < 3; ++i) sum[i] += grid.cell_area_m2() * traction[6 * cell + 3 * kind + i];
  return sum;
}

bool inside(const Positions& positions, Eigen::Index v) {
  return std::abs(positions(v, 0)) <= kGrid.width_m / 2 && std::abs(positions(v, 1)) <= kGrid.height_m / 2;
}

TEST(TractionGrid, CellsSumToTheForcesOnTheVerticesInside) {
  Positions positions;
  const FrontSurface front = square_front(31, 0.02, 0.3, positions, 0.04);
  Positions normal(positions.rows(), 3), friction(positions.rows(), 3);
  Vector3 normal_in = Vector3::Zero(), friction_in = normal_in, out = normal_in;
  for (Eigen::Index v = 0; v < positions.rows(); ++v) {
    const auto t = static_cast<double>(v);
    normal.row(v) << 0.1 * std::sin(3.0 * t), 0.2 * std::cos(t), -1.0 - 0.5 * std::sin(t);
    friction.row(v) << std::cos(5.0 * t), 0.3, 0.1 * std::sin(2.0 * t);
    (inside(positions, v) ? normal_in : out) += normal.row(v);
    if (inside(positions, v)) friction_in += friction.row(v);
  }
  const std::vector<double> traction = spread_traction(kGrid, front, positions, normal, friction);
  ASSERT_EQ(traction.size(), 24u * 32 * 2 * 3);
  EXPECT_LT((sum_of_cells(kGrid, traction, 0) - normal_in).norm(), 1e-11);
  EXPECT_LT((sum_of_cells(kGrid, traction, 1) - friction_in).norm(), 1e-11);
  EXPECT_GT(out.norm(), 100.0);
}

/// Largest error of a uniform pressure of 1 kPa, relative, in cells at least `margin` cells from the border.
double uniform_error(int n, double jitter, int margin) {
  Positions positions;
  const FrontSurface front = square_front(n, 0.03, jitter, positions);
  const std::vector<double> traction =
      spread_traction(kGrid, front, positions, pressed(front, positions, 1e3), Positions::Zero(positions.rows(), 3));
  double worst = 0.0;
  for (int row = margin; row < kGrid.rows - margin; ++row)
    for (int column = margin; column < kGrid.columns - margin; ++column)
      worst = std::max(worst, std::abs(traction[6 * (row * kGrid.columns + column) + 2] / -1e3 - 1.0));
  return worst;
}

TEST(TractionGrid, UniformPressureIsUniform) {
  // Triangles of 1, 0.5, 0.25 and 0.1 mm against cells of 0.47 mm.
  for (const int n : {30, 60, 120, 300}) {
    const int margin = 2 + 60 / n;  // two cells, and those a triangle reaches
    EXPECT_LT(uniform_error(n, 0.3, margin), 0.01) << n;
    EXPECT_LT(uniform_error(n, 0.0, margin), 0.01) << n;
  }
  // At the border a whole row of vertices is in or out: the share of a cell that a triangle covers.
  const double cell_m = kGrid.height_m / kGrid.rows;
  EXPECT_LT(uniform_error(120, 0.3, 0), 0.03 / 120 / cell_m);
  EXPECT_LT(uniform_error(300, 0.3, 0), 0.03 / 300 / cell_m);
}

TEST(TractionGrid, MirroredForcesGiveMirroredCells) {
  // Two triangles, mirror images of each other in x; one vertex each carries force.
  const Positions positions{{1.1e-3, 2e-3, 0},  {2.4e-3, 2.1e-3, 0},  {1.7e-3, 3.3e-3, 0},
                            {-1.1e-3, 2e-3, 0}, {-1.7e-3, 3.3e-3, 0}, {-2.4e-3, 2.1e-3, 0}};
  const FrontSurface front{.vertices = {0, 1, 2, 3, 4, 5}, .triangles = Triangles{{0, 1, 2}, {3, 4, 5}}};
  Positions normal = Positions::Zero(6, 3);
  normal.row(1) << 0.5, 0, -2.0;
  normal.row(5) << -0.5, 0, -2.0;
  const std::vector<double> traction = spread_traction(kGrid, front, positions, normal, Positions::Zero(6, 3));
  double largest = 0.0;
  for (int row = 0; row < kGrid.rows; ++row)
    for (int column = 0; column < kGrid.columns; ++column) {
      const double* here = &traction[6 * (row * kGrid.columns + column)];
      const double* there = &traction[6 * (row * kGrid.columns + kGrid.columns - 1 - column)];
      EXPECT_NEAR(here[0], -there[0], 1e-9 * 2.0 / kGrid.cell_area_m2());
      EXPECT_NEAR(here[2], there[2], 1e-9 * 2.0 / kGrid.cell_area_m2());
      largest = std::max(largest, -here[2]);
    }
  EXPECT_GT(largest * kGrid.cell_area_m2(), 0.1);
}

TEST(TractionGrid, RowsRunAlongYAndColumnsAlongX) {
  // A speck of a triangle near the corner of smallest x and largest y: first column, last row.
  const double x = -0.0074, y = 0.0055, e = 1e-6;
  const Positions positions{{x, y, 0}, {x + e, y, 0}, {x, y + e, 0}};
  const FrontSurface front{.vertices = {0, 1, 2}, .triangles = Triangles{{0, 1, 2}}};
  Positions normal = Positions::Zero(3, 3);
  normal(0, 2) = -1.0;
  const std::vector<double> traction = spread_traction(kGrid, front, positions, normal, Positions::Zero(3, 3));
  EXPECT_NEAR(traction[6 * (23 * 32) + 2] * kGrid.cell_area_m2(), -1.0, 1e-12);
}

TEST(TractionGrid, AVertexWhoseTrianglesHaveCollapsedStillCounts) {
  const Positions positions = Positions::Zero(3, 3);
  const FrontSurface front{.vertices = {0, 1, 2}, .triangles = Triangles{{0, 1, 2}}};
  Positions normal = Positions::Zero(3, 3);
  normal(2, 2) = -3.0;
  const std::vector<double> traction = spread_traction(kGrid, front, positions, normal, Positions::Zero(3, 3));
  EXPECT_NEAR(sum_of_cells(kGrid, traction, 0).z(), -3.0, 1e-12);
}

TEST(TractionGrid, ATriangleMuchLargerThanTheRectangleIsSpreadToo) {
  const Positions positions{{-0.001, -0.001, 0}, {1.0, 0, 0}, {0, 1.0, 0}};
  const FrontSurface front{.vertices = {0, 1, 2}, .triangles = Triangles{{0, 1, 2}}};
  Positions normal = Positions::Zero(3, 3);
  normal(0, 2) = -3.0;
  normal(1, 2) = -1.0;
  const std::vector<double> traction = spread_traction(kGrid, front, positions, normal, Positions::Zero(3, 3));
  EXPECT_NEAR(sum_of_cells(kGrid, traction, 0).z(), -3.0, 1e-9);
}

TEST(TractionGrid, StandsBeforeTheCamera) {
  const Camera camera{.position_m = {1e-3, -2e-3, -0.01}, .window_width_m = 0.012, .window_height_m = 0.009};
  const TractionGrid grid = TractionGrid::over_window(camera);
  EXPECT_EQ(grid.rows, 24);
  EXPECT_EQ(grid.columns, 32);
  EXPECT_EQ(grid.center_x_m, 1e-3);
  EXPECT_EQ(grid.center_y_m, -2e-3);
  EXPECT_DOUBLE_EQ(grid.cell_area_m2(), 0.012 / 32 * 0.009 / 24);
}

}  // namespace traction_grid_test
}  // namespace tacipc
