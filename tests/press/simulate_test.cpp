// Whole presses: against the reference solver, against itself, and starts that must be refused.
#include "stages/press/simulate.h"

#include <gtest/gtest.h>

#include <numbers>

#include "common/error.h"
#include "tests/press/reference_scene.h"
#include "tests/shared_data.h"

namespace tacipc {
namespace {

/// A structured block of gel, n × n × 2 cells of six tetrahedra each, with front at z = 0 and glued back.
TetMesh block_gel(int n, double width_m, double thickness_m) {
  TetMesh gel;
  const int nz = 2;
  const auto index = [&](int i, int j, int k) { return (k * (n + 1) + j) * (n + 1) + i; };
  gel.positions.resize((n + 1) * (n + 1) * (nz + 1), 3);
  for (int k = 0; k <= nz; ++k) {
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i) {
        gel.positions.row(index(i, j, k)) << width_m * (1.0 * i / n - 0.5), width_m * (1.0 * j / n - 0.5),
            thickness_m * (1.0 * k / nz - 1.0);
      }
    }
  }
  // Kuhn's subdivision: one tetrahedron for each order in which the three axes are walked; odd orders are mirrored.
  const int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  std::vector<std::array<int, 4>> tets;
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        for (int o = 0; o < 6; ++o) {
          int at[3] = {i, j, k};
          std::array<int, 4> tet{index(i, j, k)};
          for (int s = 0; s < 3; ++s) {
            ++at[orders[o][s]];
            tet[s + 1] = index(at[0], at[1], at[2]);
          }
          if (o >= 3) std::swap(tet[1], tet[2]);
          tets.push_back(tet);
        }
      }
    }
  }
  gel.tets.resize(static_cast<Eigen::Index>(tets.size()), 4);
  for (std::size_t t = 0; t < tets.size(); ++t)
    gel.tets.row(static_cast<Eigen::Index>(t)) << tets[t][0], tets[t][1], tets[t][2], tets[t][3];
  gel.boundary = boundary_triangles(gel.tets, gel.num_vertices());
  for (Eigen::Index f = 0; f < gel.boundary.rows(); ++f) {
    double low = 1.0, high = -1.0;
    for (int c = 0; c < 3; ++c) {
      low = std::min(low, gel.positions(gel.boundary(f, c), 2));
      high = std::max(high, gel.positions(gel.boundary(f, c), 2));
    }
    gel.tags.push_back(high < -0.999 * thickness_m ? BoundaryTag::glued
                       : low > -1e-12              ? BoundaryTag::front
                                                   : BoundaryTag::side);
  }
  return gel;
}

/// A square pyramid with its tip on −z.
TriangleMesh pyramid(double half_width_m, double height_m) {
  const double w = half_width_m, h = height_m;
  return {Positions{{0, 0, 0}, {w, w, h}, {-w, w, h}, {-w, -w, h}, {w, -w, h}},
          Triangles{{0, 2, 1}, {0, 3, 2}, {0, 4, 3}, {0, 1, 4}, {1, 2, 3}, {1, 3, 4}}};
}

SampleSpec press(double depth_m, int steps) {
  SampleSpec sample;
  sample.motion = {{.kind = PhaseKind::press, .steps = steps, .depth_m = depth_m}};
  return sample;
}

TEST(Simulate, SharpTipIntoCoarseGelEndsExactlyAtItsPoseAndInBalance) {
  const TetMesh gel = block_gel(8, 0.02, 0.002);
  const TriangleMesh object = pyramid(0.003, 0.002);
  const Simulation simulation =
      simulate(paper_sensor(), gel, object, paper_config(), press(0.5e-3, 5), "-z", ignore_progress);
  ASSERT_EQ(simulation.frames.size(), 6u);
  EXPECT_EQ(simulation.symbolic_analyses, 1);
  EXPECT_GT(simulation.frames[0].min_gap_m, simulation.d_hat_m);
  double last_force = 0.0;
  for (std::size_t f = 1; f < simulation.frames.size(); ++f) {
    const Frame& frame = simulation.frames[f];
    EXPECT_GT(frame.min_gap_m, 0.0);
    EXPECT_GT(frame.min_volume_ratio, 0.0);
    EXPECT_GT(-frame.force_n.z(), last_force);
    last_force = -frame.force_n.z();
    EXPECT_LE(frame.balance.force_n, frame.solver.force_residual_n);  // what is not balanced is what Newton left over
  }
  const Positions end = transformed(simulation.frames.back().gel_from_object, object.positions);
  EXPECT_NEAR(end.col(2).minCoeff(), -0.5e-3, 1e-15);
}

TEST(Simulate, ForceDoesNotDependOnHowTheObjectIsTurned) {
  // The block and its subdivision are the same after half a turn about z, so the press must be, too.
  const TetMesh gel = block_gel(6, 0.02, 0.002);
  const TriangleMesh object = pyramid(0.003, 0.002);
  SampleSpec turned = press(0.3e-3, 2);
  turned.rotate_rad = std::numbers::pi;
  const double a = simulate(paper_sensor(), gel, object, paper_config(), press(0.3e-3, 2), "-z", ignore_progress)
                       .frames.back()
                       .force_n.z();
  const double b =
      simulate(paper_sensor(), gel, object, paper_config(), turned, "-z", ignore_progress).frames.back().force_n.z();
  EXPECT_NEAR(a, b, 1e-3 * std::abs(a));
}

TEST(Simulate, NotConvergingIsAFailureWithItsNumbers) {
  PressConfig config = paper_config();
  config.max_newton_iterations = 2;
  try {
    simulate(paper_sensor(), block_gel(4, 0.02, 0.002), pyramid(0.003, 0.002), config, press(0.5e-3, 1), "-z",
             ignore_progress);
    FAIL() << "a capped Newton passed for a result";
  } catch (const SolverError& error) {
    EXPECT_NE(std::string(error.what()).find("frame 1: Newton did not converge within 2 iterations"), std::string::npos)
        << error.what();
  }
}

TEST(Simulate, DepthBeyondTheGelIsRefused) {
  try {
    simulate(paper_sensor(), block_gel(4, 0.02, 0.002), pyramid(0.003, 0.002), paper_config(), press(2e-3, 5), "-z",
             ignore_progress);
    FAIL() << "accepted";
  } catch (const DataError& error) {
    EXPECT_STREQ(error.what(), "depth 2 mm is not less than the gel's thickness 2 mm");
  }
}

/// The smaller of the two scenes of docs/paper.md.
TEST(Simulate, AgreesWithTheReferenceSolver) {
  TACIPC_SHARED_DATA(folder, "reference");
  const ReferenceComparison found = compare_with_reference(folder, "gel3k.msh", "sphere1k.obj", "sphere_small_press");
  EXPECT_NEAR(found.press_force_n.back(), 0.4201, 0.005 * 0.4201);
  EXPECT_LT(found.rms_m, 0.5e-6);
  EXPECT_LT(found.largest_m, 5e-6);
}

TEST(Simulate, ShearAgreesWithTheReferenceSolver) {
  TACIPC_SHARED_DATA(folder, "reference");
  const ReferenceComparison found =
      compare_with_reference(folder, "gel3k.msh", "sphere1k.obj", "sphere_small_shear", true);
  EXPECT_NEAR(found.press_force_n[4], 0.4534, 0.03 * 0.4534);
  EXPECT_NEAR(found.press_force_n[9], 0.4216, 0.03 * 0.4216);
  EXPECT_NEAR(found.tangential_force_n[9], 0.2374, 0.03 * 0.2374);
  EXPECT_LT(found.front_rms_m, 1e-6);
  EXPECT_LT(found.front_largest_m, 5e-6);
}

}  // namespace
}  // namespace tacipc
