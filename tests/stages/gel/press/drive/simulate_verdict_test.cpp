// Nothing that the verdict asks for may get lost on the way to it: frames that miss one limit each, meshes that are
// wrong from the start, and numbers that are measured.
#include <gtest/gtest.h>

#include <fmt/core.h>
#include <Eigen/LU>

#include <functional>

#include "common/base/error.h"
#include "stages/gel/press/contact/intersection_check.h"
#include "tests/make_mesh.h"
#include "tests/stages/gel/press/reference_scene.h"
#include "tests/stages/gel/press/small_scene.h"

namespace tacipc {
namespace simulate_verdict_test {

Miss missed(const Frame& frame, const SolverLimits& limits) {
  try {
    judge_frame(3, numbers_of(frame), limits);
  } catch (const VerdictError& error) {
    return error.miss();
  }
  return {};
}

TEST(SimulateVerdict, EveryNumberOfAFrameReachesItsCheck) {
  const SolverLimits limits{.velocity_residual_m_s = 1e-5, .force_residual_n = 1e-4, .friction_residual_n = 2e-4};
  Frame good;
  good.min_gap_m = 1e-6;
  good.min_volume_ratio = 0.5;
  EXPECT_EQ(missed(good, limits).check, "");
  struct Fault {
    const char* check;
    double value;
    std::function<void(Frame&)> in;
  };
  const Fault faults[] = {
      {"intersections", 2, [](Frame& f) { f.intersections = 2; }},
      {"containment", -1, [](Frame& f) { f.gel_in_object = -1; }},
      {"inverted_tets", 3, [](Frame& f) { f.inverted_tets = 3; }},
      {"smallest_distance", -1e-7, [](Frame& f) { f.min_gap_m = -1e-7; }},
      {"volume_ratio", -0.25, [](Frame& f) { f.min_volume_ratio = -0.25; }},
      {"velocity_residual", 2e-5, [](Frame& f) { f.solver.velocity_residual_m_s = 2e-5; }},
      {"force_residual", 3e-4, [](Frame& f) { f.solver.force_residual_n = 3e-4; }},
      {"friction_residual", 4e-4, [](Frame& f) { f.solver.friction_residual_n = 4e-4; }},
      {"balance", 2e-3, [](Frame& f) { f.balance.relative = 2e-3; }},
      {"pose_error", 2e-9, [](Frame& f) { f.pose_error_m = 2e-9; }},
      {"body_strain", 2e-3, [](Frame& f) { f.body_strain = 2e-3; }},
      {"body_balance", 0.25,
       [](Frame& f) {
         f.solver.body_residual_n = 0.125;
         f.solver.body_load_n = 0.5;
       }},
      {"body_torque", 0.25,
       [](Frame& f) {
         f.solver.body_residual_n_m = 0.00125;
         f.solver.body_load_n = 0.5;
       }},
  };
  for (const Fault& fault : faults) {
    Frame frame = good;
    fault.in(frame);
    EXPECT_EQ(missed(frame, limits).check, fault.check);
    EXPECT_EQ(missed(frame, limits).value, fault.value) << fault.check;
  }
  Frame unbalanced = good;
  unbalanced.balance = {.force_n = 0.0125, .relative = 0.5};
  EXPECT_EQ(numbers_of(unbalanced).balance_n, 0.0125);  // which the message tells
}

TEST(SimulateVerdict, LimitsAreWhatTheSolverWasToldToReach) {
  const NewtonSettings newton{
      .velocity_tolerance_m_s = 3e-5, .relative_force_tolerance = 1e-3, .force_tolerance_n = 1e-5};
  PressConfig config = friction_config(0.5);
  config.friction->relative_lag_tolerance = 0.01;
  const SolverLimits pressed = limits_of(config, newton, 2.0), hardly = limits_of(config, newton, 1e-4);
  EXPECT_EQ(pressed.velocity_residual_m_s, 3e-5);
  EXPECT_DOUBLE_EQ(pressed.force_residual_n, 2e-3);
  EXPECT_DOUBLE_EQ(pressed.friction_residual_n.value(), 0.02);
  EXPECT_DOUBLE_EQ(hardly.force_residual_n, 1e-5);
  EXPECT_DOUBLE_EQ(hardly.friction_residual_n.value(), 1e-5);
  config.friction->iterated = false;
  EXPECT_FALSE(limits_of(config, newton, 2.0).friction_residual_n);
}

/// What frame 0 of a press of this object into this gel fails for.
Miss refused(const TetMesh& gel, const TriangleMesh& object) {
  try {
    simulate(paper_sensor(), gel, object, paper_config(), press(0.1e-3, 1), "-z", ignore_progress);
  } catch (const VerdictError& error) {
    return error.miss();
  }
  return {};
}

/// An octahedron of gel with its top at z = 0.
TetMesh octahedron(const Positions& square, const Tetrahedra& tets) {
  TetMesh gel;
  gel.positions.resize(6, 3);
  gel.positions << square, 0, 0, -0.002, 0, 0, 0;
  gel.tets = tets;
  gel.boundary = boundary_triangles(gel.tets, 6);
  for (Eigen::Index f = 0; f < gel.boundary.rows(); ++f)
    gel.tags.push_back((gel.boundary.row(f).array() == 5).any() ? BoundaryTag::front : BoundaryTag::glued);
  return gel;
}

TEST(SimulateVerdict, ASurfaceThatCrossesItselfIsFound) {
  const Positions square{{2e-3, 0, -1e-3}, {0, 2e-3, -1e-3}, {-2e-3, 0, -1e-3}, {0, -2e-3, -1e-3}};
  const TetMesh good = octahedron(square, Tetrahedra{{0, 2, 1, 4}, {0, 3, 2, 4}, {0, 1, 2, 5}, {0, 2, 3, 5}});
  const TriangleMesh object = pyramid(0.0002, 0.0002);
  EXPECT_EQ(refused(good, object).check, "");
  // A tetrahedron of its own through one side.
  TetMesh crossed = good;
  crossed.positions.conservativeResize(10, 3);
  crossed.positions.bottomRows(4) << 0.5e-3, 0.5e-3, -1e-3, 3e-3, 2.5e-3, -1e-3, 2.5e-3, 3e-3, -1e-3, 2.5e-3, 2.5e-3,
      -0.6e-3;
  crossed.tets.conservativeResize(5, 4);
  crossed.tets.row(4) << 6, 7, 8, 9;
  crossed.boundary = boundary_triangles(crossed.tets, 10);
  crossed.tags.resize(static_cast<std::size_t>(crossed.boundary.rows()), BoundaryTag::side);
  const Miss miss = refused(crossed, object);
  EXPECT_EQ(miss.check, "intersections");
  EXPECT_EQ(miss.frame, 0);
  EXPECT_GT(miss.value, 0);
}

TEST(SimulateVerdict, AGelInsideAnObjectThatDoesNotTouchItIsFound) {
  TetMesh inside = block_gel(2, 0.004, 0.002);
  inside.positions.col(2).array() += 6e-3;
  const TriangleMesh box = make_box({-0.01, -0.01, 0.0}, {0.01, 0.01, 0.01});
  const Miss miss = refused(inside, box);
  EXPECT_EQ(miss.check, "containment");
  EXPECT_EQ(miss.frame, 0);
  EXPECT_NEAR(miss.value, 1.0, 1e-9);
}

/// Four points in a plane, all but for rounding: a tetrahedron that doubles take for one of positive volume.
TEST(SimulateVerdict, ATetrahedronThatOnlyRoundingCallsPositiveIsFound) {
  Positions square(4, 3);
  bool found = false;
  for (int trial = 0; trial < 1000 && !found; ++trial) {
    const double a = 1e-4 * std::sin(trial), b = 1e-4 * std::cos(2.0 * trial);
    square << 2e-3, a, -1e-3 + 0.3 * a, -a, 2e-3, -1e-3 + 0.3 * b, -2e-3, b, -1e-3 - 0.3 * a, 0, 0, 0;
    // The fourth corner of a parallelogram.
    square.row(3) = square.row(0) + square.row(2) - square.row(1);
    Matrix3 edges;
    for (int k = 0; k < 3; ++k) edges.col(k) = square.row(k + 1) - square.row(0);
    found = edges.determinant() > 0.0 && count_inverted_tets(square, Tetrahedra{{0, 1, 2, 3}}) == 1;
  }
  ASSERT_TRUE(found);
  // Below the square it is cut along one diagonal, above along the other; the flat one is between.
  const TetMesh gel =
      octahedron(square, Tetrahedra{{0, 2, 1, 4}, {0, 3, 2, 4}, {0, 1, 3, 5}, {1, 2, 3, 5}, {0, 1, 2, 3}});
  const Miss miss = refused(gel, pyramid(0.0002, 0.0002));
  EXPECT_EQ(miss.check, "inverted_tets");
  EXPECT_EQ(miss.frame, 0);
  EXPECT_EQ(miss.value, 1);
}

/// Objects whose lowest points go beside the gel, which reaches to ±10 mm: away from it, on legs around it, along a
/// path.
struct MissedGel {
  TriangleMesh object;
  SampleSpec sample;
  double lowest_mm;
};

std::vector<MissedGel> missed_gels() {
  MissedGel beside{pyramid(0.003, 0.002), press(0.3e-3, 2), 0.3};
  beside.sample.center_x_m = 0.015;
  // Four legs at the corners of a square of 26 mm that hold nothing above the gel.
  TriangleMesh legs;
  for (const double x : {-0.013, 0.013}) {
    for (const double y : {-0.013, 0.013}) {
      const TriangleMesh leg = make_box({x - 1e-3, y - 1e-3, 0.0}, {x + 1e-3, y + 1e-3, 5e-3});
      const auto rows = legs.positions.rows();
      legs.positions.conservativeResize(rows + leg.positions.rows(), 3);
      legs.positions.bottomRows(leg.positions.rows()) = leg.positions;
      legs.triangles.conservativeResize(legs.triangles.rows() + leg.triangles.rows(), 3);
      legs.triangles.bottomRows(leg.triangles.rows()) = leg.triangles.array() + static_cast<int>(rows);
    }
  }
  MissedGel around{legs, press(0.5e-3, 2), 0.5};
  MissedGel along{pyramid(0.003, 0.002), {}, 1.0};
  along.sample.motion = {{.kind = PhaseKind::path, .steps = 3, .absolute = true}};
  for (const double z : {2e-3, 1e-3, 0.0, -1e-3})
    along.sample.motion[0].points.push_back({.time_s = 0.01 * (2 - 1e3 * z), .shift_m = {0.0, -0.02, z}});
  return {beside, around, along};
}

TEST(SimulateVerdict, APressBesideTheGelFailsUnlessItMayMiss) {
  for (MissedGel& missed : missed_gels()) {
    const auto run = [&] {
      return simulate(paper_sensor(), block_gel(4, 0.02, 0.002), missed.object, paper_config(), missed.sample, "-z",
                      ignore_progress);
    };
    try {
      run();
      ADD_FAILURE() << missed.lowest_mm;
    } catch (const VerdictError& error) {
      EXPECT_EQ(error.miss().check, "contact");
      EXPECT_NE(std::string(error.what()).find(fmt::format("went {:g} mm below", missed.lowest_mm)), std::string::npos)
          << error.what();
    }
    missed.sample.may_miss = true;
    const Simulation simulation = run();
    for (std::size_t f = 1; f < simulation.frames.size(); ++f) {  // along the path it begins above the gel
      EXPECT_FALSE(touches(simulation.frames[f]));
      EXPECT_EQ(simulation.frames[f].min_gap_m, std::nullopt);
    }
  }
}

TEST(SimulateVerdict, AnObjectThatStaysAboveTheGelPasses) {
  SampleSpec sample;
  sample.motion = {{.kind = PhaseKind::hold, .steps = 1}, {.kind = PhaseKind::release, .steps = 2, .height_m = 1e-3}};
  const Simulation above = simulate(paper_sensor(), block_gel(4, 0.02, 0.002), pyramid(0.003, 0.002), paper_config(),
                                    sample, "-z", ignore_progress);
  EXPECT_TRUE(above.frames[1].min_gap_m);
  EXPECT_EQ(above.frames[3].min_gap_m, std::nullopt);
  const Simulation pressed = simulate(paper_sensor(), block_gel(4, 0.02, 0.002), pyramid(0.003, 0.002), paper_config(),
                                      press(0.3e-3, 1), "-z", ignore_progress);
  EXPECT_TRUE(touches(pressed.frames[1]));
}

/// A solver's residuals are not zero: one that is has not been measured. (That of friction is where the last iteration
/// with renewed friction did not move anything.)
TEST(SimulateVerdict, ResidualsAreThoseOfTheSolver) {
  SampleSpec sample = press(0.3e-3, 2);
  sample.motion.push_back({.kind = PhaseKind::shear, .steps = 2, .shift_m = {0.1e-3, 0.0, 0.0}});
  PressConfig config = friction_config(0.4);
  const auto run = [&] {
    return simulate(paper_sensor(), block_gel(6, 0.02, 0.002), pyramid(0.003, 0.002), config, sample, "-z",
                    ignore_progress);
  };
  const Simulation eliminated = run();
  double largest_friction_residual_n = 0.0;
  for (std::size_t f = 1; f < eliminated.frames.size(); ++f) {
    const FrameNumbers numbers = numbers_of(eliminated.frames[f]);
    EXPECT_GT(numbers.velocity_residual_m_s, 0.0) << f;
    EXPECT_GT(numbers.force_residual_n, 0.0) << f;
    largest_friction_residual_n = std::max(largest_friction_residual_n, numbers.friction_residual_n);
    EXPECT_GT(numbers.balance_n, 0.0) << f;
    EXPECT_GT(numbers.balance_relative, 0.0) << f;
    EXPECT_EQ(numbers.pose_error_m, 0.0) << f;
  }
  EXPECT_GT(largest_friction_residual_n, 0.0);
  // Held by multipliers, the object is where it should be but for what they leave.
  config.augmented_lagrangian = true;
  const Simulation held = run();
  for (std::size_t f = 1; f < held.frames.size(); ++f) EXPECT_GT(numbers_of(held.frames[f]).pose_error_m, 0.0) << f;
}

}  // namespace simulate_verdict_test
}  // namespace tacipc
