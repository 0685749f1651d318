#include "common/benchmark/pressed_runs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "common/base/error.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace pressed_runs_lattice_test {

/// Rows × columns places, `spacing` apart, from (−1, −2) mm on; z is 0.
Positions places(int rows, int columns, double spacing_m) {
  Positions out(rows * columns, 3);
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) out.row(r * columns + c) << -1e-3 + c * spacing_m, -2e-3 + r * spacing_m, 0.0;
  return out;
}

Vector3 wave(double x_m, double y_m) {
  return {std::sin(2e3 * x_m) * std::cos(1e3 * y_m), std::cos(1.5e3 * x_m + 2e3 * y_m), std::sin(2e3 * (x_m - y_m))};
}

double worst_error(double spacing_m) {
  const int count = static_cast<int>(std::lround(3e-3 / spacing_m)) + 1;
  const Positions rest = places(count, count, spacing_m);
  Positions values(rest.rows(), 3);
  for (Eigen::Index m = 0; m < rest.rows(); ++m) values.row(m) = wave(rest(m, 0), rest(m, 1)).transpose();
  const MarkerLattice lattice(rest, "m");
  double worst = 0.0;
  for (double x = -0.4e-3; x < 1.4e-3; x += 0.07e-3)
    for (double y = -1.4e-3; y < 0.4e-3; y += 0.06e-3)
      worst = std::max(worst, (lattice.at({x, y}, values) - wave(x, y)).norm());
  return worst;
}

TEST(MarkerLattice, IsOfThirdOrder) {
  const double coarse = worst_error(0.25e-3), fine = worst_error(0.125e-3);
  EXPECT_LT(coarse, 0.02);
  EXPECT_GT(std::log2(coarse / fine), 2.7);
}

TEST(MarkerLattice, IsExactForALinearFieldUpToTheEdgeInAnyOrder) {
  Positions rest = places(4, 5, 0.5e-3);
  rest.row(0).swap(rest.row(7));
  Positions values(20, 3);
  for (Eigen::Index m = 0; m < 20; ++m) values.row(m) << 2.0 * rest(m, 0) + 1.0, rest(m, 1) - rest(m, 0), 9.0;
  const MarkerLattice lattice(rest, "m");
  for (const auto& [x, y] : {std::pair{-1e-3, -2e-3}, {1e-3, -0.5e-3}, {0.13e-3, -1.9e-3}, {0.9e-3, -1.1e-3}})
    EXPECT_LT((lattice.at({x, y}, values) - Vector3(2.0 * x + 1.0, y - x, 9.0)).norm(), 1e-12);
  EXPECT_EQ(message_of<DataError>([&] {
              lattice.at({1.1e-3, -1e-3}, values);
            }),
            "m: a measured marker at (1.100, -1.000) mm lies outside the simulated ones");
}

TEST(MarkerLattice, RefusesWhatIsNone) {
  const std::string expected = "m: the markers at rest are not a lattice of rows and columns";
  Positions rest = places(4, 4, 1e-3);
  rest(1, 0) += 0.1e-3;
  EXPECT_EQ(message_of<DataError>([&] { MarkerLattice(rest, "m"); }), expected);
  EXPECT_EQ(message_of<DataError>([&] { MarkerLattice(places(3, 8, 1e-3), "m"); }), expected);
  rest = places(5, 5, 1e-3);
  rest.row(12) = rest.row(0);  // one place twice
  EXPECT_EQ(message_of<DataError>([&] { MarkerLattice(rest, "m"); }), expected);
}

}  // namespace pressed_runs_lattice_test
}  // namespace tacipc
