#include "stages/object/decimate/decimate.h"

#include <gmock/gmock.h>

#include <numbers>
#include <set>

#include "common/base/error.h"
#include "stages/object/decimate/decimate_object.h"
#include "stages/object/decimate/self_intersection.h"
#include "stages/object/decimate/surface_topology.h"
#include "tests/scratch_folder.h"
#include "tests/shared_data.h"
#include "tests/stages/object/decimate/shapes.h"

namespace tacipc {
namespace decimate_test {

TriangleMesh collapse(const TriangleMesh& mesh, int target) {
  CollapseReport report;
  return collapse_edges(mesh, {.target_vertices = target}, true, report);
}

TEST(Collapse, KeepsTheSurfaceClosedOrientedAndFreeOfCrossings) {
  const TriangleMesh torus = bumpy_torus(0.008, 0.003, 0.1, 120, 60);
  ASSERT_TRUE(is_closed_manifold(torus));
  for (const int target : {5000, 1000, 300}) {
    const TriangleMesh small = collapse(torus, target);
    EXPECT_EQ(small.num_vertices(), target);
    EXPECT_EQ(small.num_triangles(), 2 * target) << "a torus stays one";
    EXPECT_TRUE(is_closed_manifold(small));
    EXPECT_TRUE(self_intersections(small).empty());
    EXPECT_NEAR(signed_volume(small) / signed_volume(torus), 1.0, 0.05);
  }
}

TEST(Collapse, KeepsSomeOfTheVerticesInTheirOrder) {
  const TriangleMesh ball = sphere(0.01, 4);
  const TriangleMesh small = collapse(ball, 200);
  Eigen::Index at = 0;
  for (Eigen::Index v = 0; v < small.num_vertices(); ++v, ++at) {
    while (at < ball.num_vertices() && ball.positions.row(at) != small.positions.row(v)) ++at;
    ASSERT_LT(at, ball.num_vertices()) << "vertex " << v;
  }
}

TEST(Collapse, TakesAwayWhatCostsNothing) {
  const TriangleMesh box = cube(0.01, 12);
  const TriangleMesh small = collapse(box, 100);
  EXPECT_EQ(small.num_vertices(), 100);
  const Hausdorff distance = hausdorff_distance(box, small, {});
  EXPECT_LT(distance.max_m(), 1e-15) << "a cube needs only its corners";
}

TEST(Collapse, NeverTurnsASolidIntoASheet) {
  const TriangleMesh two = joined(sphere(0.01, 2), moved(sphere(0.001, 2), {0.02, 0, 0}));
  CollapseReport report;
  const TriangleMesh small = collapse_edges(two, {.target_vertices = 4}, true, report);
  EXPECT_TRUE(is_closed_manifold(small));
  EXPECT_GE(small.num_vertices(), 8);
  EXPECT_GT(signed_volume(small), 0.0);
}

TEST(Collapse, TakesMoreVerticesWhereFewerWouldCross) {
  // A thin washer bent to a saddle: its two sides are nearer to each other than coarse faces are to either.
  TriangleMesh washer = bumpy_torus(0.008, 0.003, 0.0, 120, 40);
  for (Eigen::Index v = 0; v < washer.num_vertices(); ++v) {
    const double x = washer.positions(v, 0), y = washer.positions(v, 1);
    washer.positions(v, 2) = 0.01 * washer.positions(v, 2) + 60.0 * (x * x - y * y);
  }
  ASSERT_TRUE(self_intersections(washer).empty());
  CollapseReport report;
  const TriangleMesh small = collapse_edges(washer, {.target_vertices = 60}, true, report);
  EXPECT_GT(report.retries, 0);
  EXPECT_GT(report.target_vertices, 60);
  EXPECT_TRUE(self_intersections(small).empty());
  EXPECT_TRUE(is_closed_manifold(small));
  CollapseReport careless;
  EXPECT_FALSE(self_intersections(collapse_edges(washer, {.target_vertices = 60}, false, careless)).empty());
}

TEST(Collapse, PassesSmallMeshesThrough) {
  const TriangleMesh ball = sphere(0.01, 3);
  CollapseReport report;
  const TriangleMesh same =
      collapse_edges(ball, {.target_vertices = static_cast<int>(ball.num_vertices())}, true, report);
  EXPECT_TRUE(report.passed_through);
  EXPECT_EQ(same.positions, ball.positions);
  EXPECT_EQ(same.triangles, ball.triangles);
}

TEST(Collapse, GivesTheSameMeshAgain) {
  const TriangleMesh torus = bumpy_torus(0.008, 0.003, 0.1, 90, 45);
  const TriangleMesh first = collapse(torus, 700), second = collapse(torus, 700);
  EXPECT_EQ(first.positions, second.positions);
  EXPECT_EQ(first.triangles, second.triangles);
}

TEST(Hausdorff, OfParallelPlatesIsTheirDistance) {
  const TriangleMesh plate =
      make_mesh({{0, 0, 0}, {0.01, 0, 0}, {0.01, 0.01, 0}, {0, 0.01, 0}}, {{0, 1, 2}, {0, 2, 3}});
  const Hausdorff distance = hausdorff_distance(plate, moved(plate, {0, 0, 2e-4}), {});
  EXPECT_NEAR(distance.first_to_second_m, 2e-4, 1e-18);
  EXPECT_NEAR(distance.second_to_first_m, 2e-4, 1e-18);
}

TEST(Hausdorff, IsNotSymmetricWhereOneSurfaceHasMore) {
  const TriangleMesh ball = sphere(0.005, 3);
  const TriangleMesh more = joined(ball, moved(ball, {0.02, 0, 0}));
  const Hausdorff distance = hausdorff_distance(ball, more, {});
  EXPECT_NEAR(distance.first_to_second_m, 0.0, 1e-15);
  EXPECT_NEAR(distance.second_to_first_m, 0.02, 1e-15);
}

TEST(Hausdorff, OfSphereSubdivisionsIsTheSagittaAndFallsFourfold) {
  // The face centre of an octahedron lies at r/√3, the finer vertices at r.
  const double r = 0.01;
  const Hausdorff coarse = hausdorff_distance(sphere(r, 0), sphere(r, 6), {});
  EXPECT_NEAR(coarse.first_to_second_m, r * (1 - 1 / std::sqrt(3.0)), 2e-5);
  double before = 0.0;
  for (const int level : {2, 3, 4}) {
    const double now = hausdorff_distance(sphere(r, level), sphere(r, 6), {.spacing_m = 1e-4}).max_m();
    if (before > 0.0) {
      EXPECT_NEAR(before / now, 4.0, 0.3) << "level " << level;
    }
    before = now;
  }
}

TEST(Hausdorff, AgreesWithBruteForceAndSpacingIsLimited) {
  const TriangleMesh a = bumpy_torus(0.008, 0.003, 0.1, 12, 9), b = bumpy_torus(0.008, 0.003, 0.05, 10, 8);
  double farthest = 0.0;
  for (Eigen::Index v = 0; v < a.num_vertices(); ++v) {
    double nearest = 1.0;
    for (int f = 0; f < static_cast<int>(b.num_triangles()); ++f) {
      // Ternary search over a fine barycentric grid would be as long as the code under test: sample densely instead.
      for (int i = 0; i <= 60; ++i)
        for (int j = 0; i + j <= 60; ++j) {
          const Vector3 y = (corner(b, f, 0) * (60 - i - j) + corner(b, f, 1) * i + corner(b, f, 2) * j) / 60.0;
          nearest = std::min(nearest, (a.positions.row(v).transpose() - y).norm());
        }
    }
    farthest = std::max(farthest, nearest);
  }
  const Hausdorff vertices_only = hausdorff_distance(a, b, {.spacing_m = 1.0});
  EXPECT_GE(vertices_only.first_to_second_m, farthest - 1e-5);
  EXPECT_EQ(vertices_only.first_samples, 4 * a.num_triangles());
  const Hausdorff limited = hausdorff_distance(a, b, {.spacing_m = 1e-6, .max_samples = 5000});
  EXPECT_LE(limited.first_samples, 5000);
  EXPECT_GT(limited.first_samples, 1000);
}

TEST(DecimateConfig, ReadsTheDefaultFile) {
  const auto config = read_config<DecimateConfig>(TACIPC_SOURCE_DIR "/configs/objects/decimate/default.yaml");
  EXPECT_EQ(config.collapse.target_vertices, 8000);
  EXPECT_EQ(config.doctor.max_extent_m, 0.5);
}

class RealObjects : public ::testing::TestWithParam<const char*> {};

TEST_P(RealObjects, PassTheDoctorAndStayUnderTheTarget) {
  TACIPC_SHARED_DATA(folder, GetParam());
  auto config = read_config<DecimateConfig>(TACIPC_SOURCE_DIR "/configs/objects/decimate/default.yaml");
  config.hausdorff.spacing_m = 5e-4;
  const std::set<std::string> non_manifold{"board4", "key_2762"};  // edges of more than two faces
  int seen = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const TriangleMesh mesh = read_triangle_mesh(entry.path(), 1e-3);
    const DecimatedObject object = decimate_object(mesh, config);
    EXPECT_TRUE(is_closed_manifold(object.mesh)) << entry.path();
    EXPECT_GT(signed_volume(object.mesh), 0.0) << entry.path();
    EXPECT_LE(object.mesh.num_vertices(), 8000) << entry.path();
    DoctorReport report;
    treat_mesh(mesh, config.doctor, report);
    EXPECT_EQ(report.separated_edges > 0, non_manifold.contains(entry.path().stem())) << entry.path();
    ++seen;
  }
  EXPECT_GT(seen, 0);
}

INSTANTIATE_TEST_SUITE_P(Folders, RealObjects,
                         ::testing::Values("data/printed_indenters", "data/tacipc_release/objects",
                                           "data/gelsight_sim2real/meshes"));

}  // namespace decimate_test
}  // namespace tacipc
