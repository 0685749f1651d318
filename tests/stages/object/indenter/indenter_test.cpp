#include <fmt/core.h>
#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "common/base/error.h"
#include "stages/object/indenter/ball.h"
#include "stages/object/indenter/rounded_field.h"
#include "tests/program_test.h"

namespace tacipc {
namespace indenter_test {

/// Every edge lies in two triangles, once in each direction.
bool closed(const TriangleMesh& mesh) {
  std::map<std::pair<int, int>, int> edges;
  for (Eigen::Index t = 0; t < mesh.num_triangles(); ++t)
    for (int k = 0; k < 3; ++k) ++edges[{mesh.triangles(t, k), mesh.triangles(t, (k + 1) % 3)}];
  for (const auto& [edge, count] : edges)
    if (count != 1 || !edges.contains({edge.second, edge.first})) return false;
  return true;
}

TEST(Ball, IsClosedOutwardAndFineEnough) {
  const TriangleMesh mesh = ball_mesh(3e-3, 0.5e-3);
  EXPECT_TRUE(closed(mesh));
  EXPECT_EQ(mesh.num_vertices(), 2 + 10 * 64);  // three splits: 10 · 4ⁿ + 2
  for (Eigen::Index i = 0; i < mesh.num_vertices(); ++i) EXPECT_NEAR(mesh.positions.row(i).norm(), 3e-3, 1e-15);
  // A polyhedron of edges e within a sphere lacks about e²/(4 R²) of its volume.
  const double volume = 4.0 / 3.0 * std::numbers::pi * 27e-9;
  EXPECT_NEAR(signed_volume(mesh) / volume, 1.0, 0.02);
  EXPECT_LT(signed_volume(mesh), volume);
  EXPECT_THROW(ball_mesh(1.0, 1e-6), DataError);
}

/// A box, closed, outward.
TriangleMesh box(double x, double y, double z) {
  TriangleMesh mesh;
  mesh.positions.resize(8, 3);
  for (int i = 0; i < 8; ++i) mesh.positions.row(i) << (i & 1 ? x : 0.0), (i & 2 ? y : 0.0), (i & 4 ? z : 0.0);
  mesh.triangles.resize(12, 3);
  mesh.triangles << 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7,
      1, 7, 5;
  return mesh;
}

TEST(HeightField, HighestPointsOfABoxIncludeItsWalls) {
  const HeightField field = highest_points(box(1.0e-3, 0.6e-3, 2e-3), 0.1e-3, 0.25e-3);
  EXPECT_EQ(field.columns, 17);  // (0.5 + 0.25) / 0.1 rounded up, both ways
  int inside = 0;
  for (const double z : field.z) inside += std::isfinite(z) ? 1 : 0;
  EXPECT_EQ(inside, 11 * 7);
  EXPECT_NEAR(field.at(8, field.rows / 2), 2e-3, 1e-15);
  EXPECT_EQ(field.at(0, 0), -std::numeric_limits<double>::infinity());
}

TEST(HeightField, OpeningGivesEdgesTheBallsRadiusAndLeavesFlats) {
  constexpr double kEdge = 0.3e-3, kStep = 0.02e-3;
  const HeightField field = opened(highest_points(box(2e-3, 2e-3, 2e-3), kStep, 0.4e-3), kEdge);
  const int row = field.rows / 2;
  for (int i = 0; i < field.columns; ++i) {
    const double from_wall = 1e-3 - std::abs(field.x0 + i * kStep - 1e-3);  // > 0 inside
    if (from_wall < -1e-9) {
      EXPECT_EQ(field.at(i, row), -std::numeric_limits<double>::infinity());
    } else if (from_wall >= kEdge) {
      EXPECT_NEAR(field.at(i, row), 2e-3, 1e-15);
    } else if (from_wall > 0.1e-3) {
      // A quarter circle: 2 mm − r + √(r² − (r − s)²).
      const double s = kEdge - from_wall;
      EXPECT_NEAR(field.at(i, row), 2e-3 - kEdge + std::sqrt(kEdge * kEdge - s * s), 0.02e-3) << from_wall;
    }
  }
  // A groove narrower than the ball stays: opening only takes away.
  HeightField groove{.columns = 9, .rows = 9, .spacing = 1.0, .z = std::vector<double>(81, 5.0)};
  for (int j = 0; j < 9; ++j) groove.at(4, j) = 1.0;
  EXPECT_EQ(opened(groove, 0.0).at(4, 4), 1.0);
}

TEST(HeightField, RoundedEdgesAreWhereTheyBelongOnACoarseGridToo) {
  constexpr double kEdge = 0.3e-3;
  for (const double step : {0.05e-3, 0.1e-3, 0.07e-3}) {
    const HeightField field = rounded(box(2e-3, 2e-3, 2e-3), kEdge, step, 0.4e-3);
    EXPECT_NEAR(field.x0 + 0.5 * (field.columns - 1) * step, 1e-3, 1e-12);  // centred on the box
    EXPECT_GE(0.5 * (field.columns - 1) * step, 1.4e-3 - step);
    const int row = field.rows / 2;
    for (int i = 0; i < field.columns; ++i) {
      const double from_wall = 1e-3 - std::abs(field.x0 + i * step - 1e-3);
      if (from_wall < 0.1e-3) continue;
      const double s = std::max(0.0, kEdge - from_wall);
      // Slope s / √(r² − s²) times a 24th of the radius.
      const double slope = s / std::sqrt(kEdge * kEdge - s * s);
      EXPECT_NEAR(field.at(i, row), 2e-3 - kEdge + std::sqrt(kEdge * kEdge - s * s), 1e-6 + slope * kEdge / 24)
          << from_wall;
    }
  }
}

TEST(HeightField, SolidsAreClosedAndEncloseTheirVolume) {
  HeightField field{.columns = 5, .rows = 4, .spacing = 1e-3, .z = std::vector<double>(20, 1e-3)};
  field.at(2, 2) = 3e-3;
  field.at(1, 1) = -std::numeric_limits<double>::infinity();
  const TriangleMesh mesh = solid(field, 4e-3);
  EXPECT_TRUE(closed(mesh));
  EXPECT_GT(signed_volume(mesh), 0.0);
  EXPECT_NEAR(mesh.positions.col(2).maxCoeff(), 3e-3, 1e-15);
  EXPECT_NEAR(mesh.positions.col(2).minCoeff(), -5e-3, 1e-15);
}

class IndenterProgram : public ProgramTest {
 protected:
  int run(const std::string& config, const std::string& more) {
    scratch_.file("i.yaml", config);
    return run_command(fmt::format("cd '{}' && {}/indenter --config i.yaml --log-level error {}",
                                   (scratch_ / "").string(), TACIPC_BIN_DIR, more));
  }
};

TEST_F(IndenterProgram, RoundsAMeshTheSameWayWithAnyThreads) {
  write_ply(scratch_ / "box.ply", box(2e-3, 2e-3, 5e-3));
  const std::string config = "mesh: {unit: m, edge_radius_mm: 0.3, spacing_mm: 0.1, relief_mm: 2}\n";
  ASSERT_EQ(run(config, "--mesh box.ply --out a --threads 1"), 0) << said_;
  ASSERT_EQ(run(config, "--mesh box.ply --out b --threads 3"), 0) << said_;
  EXPECT_EQ(content_hash(scratch_ / "a"), content_hash(scratch_ / "b"));
  EXPECT_TRUE(closed(read_triangle_mesh(scratch_ / "a/object.ply", 1.0)));
  EXPECT_EQ(run(config, "--out a"), 2);
  EXPECT_EQ(said_, "indenter: error: --mesh: needed where the configuration rounds one, and only there\n");
  EXPECT_EQ(run("mesh: {unit: m, edge_radius_mm: 1.5, spacing_mm: 0.1, relief_mm: 4}\n", "--mesh box.ply --out a"), 1);
  EXPECT_EQ(said_, "indenter: error: box.ply: opened with a ball of 1.5 mm, nothing of it remains\n");
  EXPECT_EQ(run("ball: {radius_mm: 3, edge_mm: 4}\n", "--out a"), 2);
  EXPECT_EQ(said_, "i.yaml:1:31: ball.edge_mm: must not exceed the radius\n");
}

}  // namespace indenter_test
}  // namespace tacipc
