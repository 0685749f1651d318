#include "stages/gel/tetmesh/generate.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <numbers>

#include "common/base/error.h"
#include "stages/gel/tetmesh/face_mesh.h"
#include "stages/gel/tetmesh/gel_surface.h"
#include "stages/gel/tetmesh/isolated.h"
#include "stages/gel/tetmesh/mesh_check.h"
#include "tests/scratch_folder.h"
#include "tests/stages/gel/tetmesh/gels.h"

namespace tacipc {
namespace generate_test {

/// A sizing for gels of a few hundred vertices.
GenerateConfig coarse(double uniform_m) {
  GenerateConfig config = preset("tiny");
  config.sizing = {};
  config.max_vertices = 20000;
  config.fill.circumradius_ratio = 0.75;
  config.sizing.centre_m = config.sizing.inner_m = config.sizing.rim_m = config.sizing.back_m = uniform_m;
  return config;
}

GelShape dome(GelShape gel, double radius_m) {
  gel.dome_radius_m = radius_m;
  return gel;
}

/// What must hold of every generated gel beyond what generate_gel checks itself.
void expect_gel(const GelShape& gel, const GenerateConfig& config, double volume_tolerance) {
  const TetMesh mesh = generate_gel(gel, config);
  check_gel(mesh, gel, {.min_dihedral_deg = config.min_dihedral_deg}, "gel");
  EXPECT_NEAR(volume_of(mesh) / analytic_volume(gel), 1.0, volume_tolerance);
  for (const int v : mesh.vertices(BoundaryTag::glued)) EXPECT_EQ(mesh.positions(v, 2), -gel.thickness_m);
  for (const int v : mesh.vertices(BoundaryTag::front))
    EXPECT_EQ(mesh.positions(v, 2), gel.front_z(mesh.positions(v, 0), mesh.positions(v, 1)));
  // Every boundary vertex belongs to exactly the faces its place says: side and front share the front's rim.
  const Triangles front = mesh.faces(BoundaryTag::front);
  for (Eigen::Index f = 0; f < front.rows(); ++f) {
    const Vector3 a = mesh.positions.row(front(f, 0)), b = mesh.positions.row(front(f, 1)),
                  c = mesh.positions.row(front(f, 2));
    EXPECT_GT((b - a).cross(c - a).z(), 0.0) << "front triangle " << f;
  }
  expect_wanted_edges(mesh, gel, config, 0.15, 40);
}

TEST(GenerateGel, TinyPresetIsSmallAndWhole) {
  const GenerateConfig config = preset("tiny");
  expect_gel(mctac_gel(), config, 0.02);
  const TetMesh mesh = generate_gel(mctac_gel(), config);
  EXPECT_LT(mesh.num_vertices(), 400);
  EXPECT_GT(mesh.num_vertices(), 200);
}

TEST(GenerateGel, Rectangles) {
  expect_gel(rectangle_gel(0.02, 0.016, 0.004), coarse(1.5e-3), 1e-12);
  GenerateConfig graded = preset("adaptive_0250um");
  graded.sizing.centre_m = graded.sizing.inner_m = 6e-4;
  expect_gel(rectangle_gel(0.026, 0.02, 0.004), graded, 1e-12);
}

TEST(GenerateGel, Domes) {
  expect_gel(dome(mctac_gel(), 0.08), coarse(1e-3), 0.015);
  expect_gel(dome(disc_gel(0.01, 0.006), 0.0125), coarse(8e-4), 0.015);
  expect_gel(dome(disc_gel(0.012, 0.0095), 0.0125), coarse(1e-3), 0.03);  // 74 degrees steep at the rim
  expect_gel(dome(rectangle_gel(0.02, 0.016, 0.004), 0.05), coarse(1e-3), 0.01);
}

TEST(GenerateGel, EdgesLongerThanTheGelLeaveTheCoarsestShape) {
  const TetMesh box = generate_gel(rectangle_gel(0.02, 0.016, 0.004), coarse(0.1));
  EXPECT_EQ(box.vertices(BoundaryTag::front).size(), 4u);
  EXPECT_NEAR(volume_of(box), 0.02 * 0.016 * 0.004, 1e-18);
}

TEST(GenerateGel, FrontIsEvenAndShowsNoLattice) {
  const GelShape gel = mctac_gel();
  const GelSurface surface = gel_surface(sizing_for(coarse(5e-4).sizing, gel), 1);
  Triangles front(0, 3);
  for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
    if (surface.tags[static_cast<std::size_t>(f)] != BoundaryTag::front) continue;
    front.conservativeResize(front.rows() + 1, 3);
    front.row(front.rows() - 1) = surface.triangles.row(f);
  }
  double sum = 0.0, squares = 0.0, shortest = 1.0;
  // Sixfold order of edge directions over the whole face: 1 for one lattice, about 0 for none.
  double order_x = 0.0, order_y = 0.0;
  const auto edges = unique_edges(front);
  for (const auto& [i, j] : edges) {
    const Vector3 edge = surface.positions.row(i) - surface.positions.row(j);
    sum += edge.norm();
    squares += edge.squaredNorm();
    shortest = std::min(shortest, edge.norm());
    const double angle = 6.0 * std::atan2(edge.y(), edge.x());
    order_x += std::cos(angle);
    order_y += std::sin(angle);
  }
  const double count = static_cast<double>(edges.size()), mean = sum / count;
  EXPECT_LT(std::sqrt(squares / count - mean * mean) / mean, 0.12);
  EXPECT_GT(shortest, 0.6 * 5e-4);
  EXPECT_LT(std::hypot(order_x, order_y) / count, 0.1);
}

TEST(GenerateGel, SeedsGiveOtherMeshesOfTheSameKind) {
  GenerateConfig config = preset("tiny");
  const TetMesh first = generate_gel(mctac_gel(), config);
  EXPECT_EQ(generate_gel(mctac_gel(), config).positions, first.positions);
  config.seed = 2;
  const TetMesh second = generate_gel(mctac_gel(), config);
  EXPECT_NEAR(static_cast<double>(second.num_vertices()), static_cast<double>(first.num_vertices()), 20);
  EXPECT_NE(second.positions.topRows(100), first.positions.topRows(100));
}

TEST(GenerateGel, RefusesWhatIsTooFineBeforeItWorks) {
  GenerateConfig config = coarse(1e-6);
  EXPECT_EQ(message_of<DataError>([&] { generate_gel(mctac_gel(), config); }),
            "the sizing asks for about 2e+12 vertices, more than max_vertices 20000");
  config.sizing.centre_m = 1e-9;
  EXPECT_NE(message_of<DataError>([&] { generate_gel(mctac_gel(), config); }), "");
}

TEST(GenerateGel, RefusesAMeshBelowTheAngleLimit) {
  GenerateConfig config = preset("tiny");
  config.min_dihedral_deg = 20.0;
  const std::string message = message_of<DataError>([&] { generate_gel(mctac_gel(), config); });
  EXPECT_NE(message.find(" degrees, below the limit of 20"), std::string::npos) << message;
  EXPECT_EQ(message.find("gel: tet "), 0u) << message;
}

TEST(GenerateGel, RefinementWithoutEndStopsAtTheLimit) {
  GenerateConfig config = coarse(2e-3);
  config.max_vertices = 3000;
  config.fill.circumradius_ratio = 0.3;
  EXPECT_EQ(
      message_of<DataError>([&] { generate_gel(rectangle_gel(0.02, 0.02, 0.02), config); }),
      "the refinement reached max_vertices 3000; radius_edge_ratio 1.4 or circumradius_ratio 0.3 may be too small");
}

TEST(FillWithTets, ACrashOfTetGenIsAnError) {
  GelSurface surface = gel_surface(sizing_for(preset("tiny").sizing, mctac_gel()), 1);
  surface.positions(60, 2) = -0.01;  // a front vertex, pulled through the back
  const std::string message =
      message_of<DataError>([&] { fill_with_tets(surface, preset("tiny").fill, [](const Vector3&) { return 1e-3; }); });
  EXPECT_EQ(message.find("TetGen (pYq1.4/12O4/7S"), 0u) << message;
}

TEST(RunIsolated, GivesBackBytesErrorsAndDeaths) {
  const std::string bytes("a\0b", 3);
  EXPECT_EQ(run_isolated("work", [&] { return bytes; }), bytes);
  const std::string large(3 << 20, 'x');
  EXPECT_EQ(run_isolated("work", [&] { return large; }), large);
  const auto fault = [](const std::function<std::string()>& work) {
    return message_of<DataError>([&] { run_isolated("work", work); });
  };
  EXPECT_EQ(fault([]() -> std::string { throw DataError("failed at {}", 7); }), "work failed at 7");
  EXPECT_EQ(fault([]() -> std::string {
              std::raise(SIGKILL);
              return "";
            }),
            "work crashed (signal 9)");
  EXPECT_EQ(fault([]() -> std::string { ::_exit(3); }), "work ended without a result");
}

TEST(AnalyticVolume, DomesByAnotherFormula) {
  const GelShape gel{.radius_m = 0.01, .thickness_m = 0.006, .dome_radius_m = 0.02};
  // A cylinder up to the rim and a spherical cap π h² (3R − h) / 3 on it.
  const double cap = 0.02 - std::sqrt(0.02 * 0.02 - 0.01 * 0.01);
  const double by_hand = std::numbers::pi * (0.01 * 0.01 * (0.006 - cap) + cap * cap * (3 * 0.02 - cap) / 3.0);
  EXPECT_NEAR(analytic_volume(gel), by_hand, 1e-12 * by_hand);
  // Far from the dome's edge −z is (x² + y²) / 2R, whose mean over a rectangle is (w² + h²) / 24R.
  GelShape flat = rectangle_gel(0.02, 0.016, 0.004);
  flat.dome_radius_m = 10.0;
  const double mean_sag = (0.02 * 0.02 + 0.016 * 0.016) / 240.0;
  EXPECT_NEAR(analytic_volume(flat) / (0.02 * 0.016), 0.004 - mean_sag, 1e-6 * mean_sag);
}

}  // namespace generate_test
}  // namespace tacipc
