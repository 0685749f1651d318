// Gels under motions of several phases: friction, loads, interruption, constraints by multipliers.
#include <gtest/gtest.h>

#include <numbers>

#include "common/base/error.h"
#include "common/sample/placement.h"
#include "stages/gel/press/drive/checkpoint.h"
#include "tests/make_mesh.h"
#include "tests/stages/gel/press/drive/memory_store.h"
#include "tests/stages/gel/press/reference_scene.h"
#include "tests/stages/gel/press/small_scene.h"

namespace tacipc {
namespace simulate_moved_gel_test {

/// A flat-ended square punch.
TriangleMesh punch(double half_width_m, double height_m) {
  return make_box({-half_width_m, -half_width_m, 0.0}, {half_width_m, half_width_m, height_m});
}

Simulation run(const TriangleMesh& object, const PressConfig& config, const SampleSpec& sample,
               FrameStore* store = nullptr) {
  return simulate(paper_sensor(), block_gel(8, 0.02, 0.002), object, config, sample, "-z", ignore_progress, store);
}

SampleSpec long_motion() {
  SampleSpec sample;
  sample.density_kg_m3 = 1000.0;
  sample.motion = {{.kind = PhaseKind::press, .steps = 3, .depth_m = 0.3e-3},
                   {.kind = PhaseKind::shear, .steps = 2, .shift_m = {0.2e-3, 0.1e-3, 0.0}},
                   {.kind = PhaseKind::twist, .steps = 2, .angle_rad = 0.1},
                   {.kind = PhaseKind::press, .steps = 2, .load_n = Vector3(0, 0, -0.4), .free = {false, false, true}},
                   {.kind = PhaseKind::hold, .steps = 1},
                   {.kind = PhaseKind::release, .steps = 2}};
  return sample;
}

TEST(MovedGel, GoesOnFromAnyFrameToTheSameBytes) {
  const TriangleMesh object = pyramid(0.003, 0.002);
  MemoryStore whole;
  const Simulation simulation = run(object, friction_config(0.5), long_motion(), &whole);
  ASSERT_EQ(simulation.frames.size(), 13u);
  EXPECT_EQ(simulation.frames[4].phase, PhaseKind::shear);
  EXPECT_GT(simulation.frames[5].force_n.head<2>().norm(), 0.01);
  EXPECT_EQ(simulation.frames.back().force_n, Vector3::Zero());
  for (const std::size_t known : {1, 4, 6, 9, 12}) {
    MemoryStore rest({whole.saved.begin(), whole.saved.begin() + static_cast<std::ptrdiff_t>(known)});
    run(object, friction_config(0.5), long_motion(), &rest);
    EXPECT_TRUE(rest.saved == whole.saved) << "from " << known << " frames";
  }
}

TEST(MovedGel, FrictionRenewedBeforeIterationsIsThatRenewedAtMinima) {
  const TriangleMesh object = pyramid(0.003, 0.002);
  PressConfig config = friction_config(0.7);
  config.relative_velocity_tolerance = 1e-5;
  config.newton.relative_force_tolerance = 1e-6;
  config.friction->relative_lag_tolerance = 1e-5;
  SampleSpec sample;
  sample.motion = {{.kind = PhaseKind::press, .steps = 3, .depth_m = 0.3e-3},
                   {.kind = PhaseKind::shear, .steps = 3, .shift_m = {0.3e-3, 0.1e-3, 0.0}},
                   {.kind = PhaseKind::hold, .steps = 1}};
  const Simulation often = run(object, config, sample);
  config.friction->only_at_minima = true;
  const Simulation at_minima = run(object, config, sample);
  config.friction->iterated = false;
  const Simulation once = run(object, config, sample);
  double lag_matters = 0.0;
  for (std::size_t f = 1; f < often.frames.size(); ++f) {
    const double force = at_minima.frames[f].force_n.norm();
    EXPECT_LT((often.frames[f].force_n - at_minima.frames[f].force_n).norm(), 1e-4 * force) << f;
    EXPECT_LT((often.frames[f].positions - at_minima.frames[f].positions).rowwise().norm().maxCoeff(), 2e-7) << f;
    EXPECT_GT(often.frames[f].solver.lag_iterations, 0) << f;
    lag_matters = std::max(lag_matters, (once.frames[f].force_n - at_minima.frames[f].force_n).norm() / force);
  }
  EXPECT_GT(lag_matters, 5e-3);  // the yardstick tells friction lagged once from both
}

TEST(MovedGel, IterationsAreCountedOverAllRenewalsOfFriction) {
  PressConfig config = friction_config(0.7);
  config.friction->only_at_minima = true;
  SampleSpec sample;
  sample.motion = {{.kind = PhaseKind::press, .steps = 1, .depth_m = 0.1e-3}};
  const TriangleMesh object = pyramid(0.003, 0.002);
  const StepReport solver = run(object, config, sample).frames[1].solver;
  ASSERT_GT(solver.lag_iterations, 1);
  config.max_halvings = 0;
  config.newton.max_iterations = solver.newton_iterations;
  EXPECT_NO_THROW(run(object, config, sample));
  config.newton.max_iterations = solver.newton_iterations - 1;
  EXPECT_THROW(run(object, config, sample), SolverError);
}

TEST(MovedGel, DamagedFramesAreRefused) {
  MemoryStore whole;
  run(pyramid(0.003, 0.002), paper_config(), press(0.1e-3, 1), &whole);
  Frame frame;
  PressProgress progress;
  EXPECT_THROW(unpack_frame(std::string_view(whole.saved[1]).substr(0, 1000), frame, progress), DataError);
  EXPECT_THROW(unpack_frame(whole.saved[1] + "x", frame, progress), DataError);
  EXPECT_NO_THROW(unpack_frame(whole.saved[1], frame, progress));
  EXPECT_EQ(pack_frame(frame, progress), whole.saved[1]);
}

TEST(MovedGel, ALoadIsCarriedAndTheObjectStaysOnItsOtherAxes) {
  SampleSpec sample;
  sample.density_kg_m3 = 1000.0;
  sample.motion = {{.kind = PhaseKind::press, .steps = 4, .load_n = Vector3(0, 0, -0.5), .free = {false, false, true}},
                   {.kind = PhaseKind::hold, .steps = 3}};
  const Simulation simulation = run(pyramid(0.003, 0.002), friction_config(0.5), sample);
  EXPECT_NEAR(simulation.object_mass_kg, 1000.0 * 0.006 * 0.006 * 0.002 / 3.0, 1e-12);
  for (std::size_t f = 1; f < simulation.frames.size(); ++f) {
    const Frame& frame = simulation.frames[f];
    const double load = std::min(1.0, static_cast<double>(f) / 4.0) * 0.5;
    // The object's own inertia takes a little while it moves.
    EXPECT_NEAR(-frame.force_n.z(), load, f < 5 ? 0.02 * 0.5 : 1e-3 * 0.5) << f;
    EXPECT_EQ(frame.gel_from_object(0, 3), simulation.frames[0].gel_from_object(0, 3));
    EXPECT_LE(frame.balance.relative, 1e-3);
  }
  EXPECT_LT(simulation.frames.back().gel_from_object(2, 3), simulation.frames[1].gel_from_object(2, 3));
}

TEST(MovedGel, APunchThatSlidesIsHeldByMuTimesItsLoad) {
  SampleSpec sample;
  sample.density_kg_m3 = 1000.0;
  sample.motion = {{.kind = PhaseKind::press, .steps = 5, .load_n = Vector3(0, 0, -0.3), .free = {false, false, true}},
                   {.kind = PhaseKind::shear, .steps = 1, .shift_m = {0.01e-3, 0.0, 0.0}},
                   {.kind = PhaseKind::shear, .steps = 6, .shift_m = {2e-3, 0.0, 0.0}}};
  const Simulation simulation = run(punch(0.003, 0.003), friction_config(0.3), sample);
  const Frame& first = simulation.frames[6];
  EXPECT_LT(first.force_n.x() / -first.force_n.z(), 0.29);  // sticks at first …
  EXPECT_GT(std::count(first.contact_state.begin(), first.contact_state.end(), ContactState::stick), 0);
  const Frame& last = simulation.frames.back();
  EXPECT_GT(std::count(last.contact_state.begin(), last.contact_state.end(), ContactState::slip), 0);
  // … and then slides: the friction forces are μ times the normal forces, vertex by vertex.
  double friction = 0.0, normal = 0.0;
  for (Eigen::Index v = 0; v < last.normal_force_n.rows(); ++v) {
    friction += last.friction_force_n.row(v).norm();
    normal += last.normal_force_n.row(v).norm();
  }
  EXPECT_NEAR(friction / normal, 0.3, 0.01 * 0.3);
}

/// Where a tip presses, its contact is far stiffer than all else: a linear step closes its gap, and would end the move.
TEST(MovedGel, AStiffContactDoesNotEndTheObjectsMove) {
  const Simulation simulation = run(pyramid(0.003, 0.002), friction_config(0.5), press(0.6e-3, 4));
  for (std::size_t f = 2; f < simulation.frames.size(); ++f)
    EXPECT_EQ(simulation.frames[f].solver.moving_iterations, 1) << f;
}

/// What a step that had to be halved ends with is what two steps of half the time step end with, and says so.
TEST(MovedGel, AStepThatIsTooLongIsDivided) {
  PressConfig config = friction_config(0.5);
  config.friction->only_at_minima = true;
  PressConfig halves = config;
  halves.time_step_s /= 2.0;
  halves.barrier_stiffness = *halves.barrier_stiffness / 4.0;  // κ/h² is that of the whole step
  const Simulation expected = run(pyramid(0.003, 0.002), halves, press(0.9e-3, 2));
  const Frame &first = expected.frames[1], &second = expected.frames[2];
  // Just enough for a half, too few for the whole.
  config.newton.max_iterations = std::max(first.solver.newton_iterations, second.solver.newton_iterations);
  config.max_halvings = 1;
  const Simulation divided = run(pyramid(0.003, 0.002), config, press(0.9e-3, 1));
  ASSERT_EQ(divided.frames.size(), 2u);
  const Frame& end = divided.frames[1];
  EXPECT_EQ(end.solver.time_steps, 2);
  EXPECT_NEAR(end.time_s, 0.01, 1e-15);
  EXPECT_NEAR(second.time_s, 0.01, 1e-15);
  EXPECT_LT((end.gel_from_object - second.gel_from_object).norm(), 1e-15);
  EXPECT_LT((end.positions - second.positions).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((end.force_n - second.force_n).norm(), 1e-9 * second.force_n.norm());
  EXPECT_EQ(end.solver.newton_iterations, first.solver.newton_iterations + second.solver.newton_iterations);
  EXPECT_EQ(end.solver.lag_iterations, first.solver.lag_iterations + second.solver.lag_iterations);
  EXPECT_EQ(end.solver.moving_iterations, first.solver.moving_iterations + second.solver.moving_iterations);
}

TEST(MovedGel, AugmentedLagrangianGivesTheAnswerOfElimination) {
  SampleSpec sample = press(0.3e-3, 3);
  // Off every symmetry of the mesh: with one there are two answers, each the other's mirror image.
  sample.rotate_rad = 0.4;
  sample.center_x_m = 0.4e-3;
  sample.center_y_m = 0.9e-3;
  sample.motion.push_back({.kind = PhaseKind::shear, .steps = 2, .shift_m = {0.1e-3, 0.0, 0.0}});
  PressConfig config = friction_config(0.4);
  config.newton.relative_force_tolerance = 1e-6;
  config.newton.force_tolerance_n = 1e-9;
  config.friction->relative_lag_tolerance = 1e-5;
  const Simulation eliminated = run(pyramid(0.003, 0.002), config, sample);
  config.augmented_lagrangian = true;
  const Simulation augmented = run(pyramid(0.003, 0.002), config, sample);
  for (std::size_t f = 1; f < eliminated.frames.size(); ++f) {
    const Frame &a = eliminated.frames[f], &b = augmented.frames[f];
    EXPECT_LT((a.positions - b.positions).cwiseAbs().maxCoeff(), 1e-8) << f;
    EXPECT_LT((a.force_n - b.force_n).norm(), 1e-4 * a.force_n.norm()) << f;
    EXPECT_LE(b.pose_error_m, 1e-9);
    EXPECT_EQ(a.gel_from_object, b.gel_from_object);
  }
}

TEST(MovedGel, ALoadNeedsElimination) {
  PressConfig config = paper_config();
  config.augmented_lagrangian = true;
  EXPECT_THROW(run(pyramid(0.003, 0.002), config, long_motion()), UsageError);
}

/// Weight sags the gel by what its column carries: σ = ρ g (z + h) in a wide layer, so u = ρ g h² / (2 M) at the front.
TEST(MovedGel, GravityAndQuasiStaticModeAgreeWithTheWeightOfALayer) {
  PressConfig config = paper_config();
  config.quasi_static = true;
  config.gravity_m_s2 = Vector3(0, 0, -1000.0);
  config.start_gap_d_hat = 20.0;
  SampleSpec sample;
  sample.motion = {{.kind = PhaseKind::hold, .steps = 1}};
  const Sensor sensor = paper_sensor();
  const TetMesh gel = block_gel(16, 0.04, 0.002);
  const Simulation simulation =
      simulate(sensor, gel, pyramid(0.001, 0.001), config, sample, "-z", ignore_progress, nullptr);
  const double modulus = sensor.material.lame_lambda_pa() + 2.0 * sensor.material.lame_mu_pa();
  const double expected = 1010.0 * 1000.0 * 0.002 * 0.002 / (2.0 * modulus);
  double sum = 0.0;
  int count = 0;
  for (Eigen::Index v = 0; v < gel.num_vertices(); ++v) {
    if (gel.positions(v, 2) < -1e-9 || gel.positions.row(v).cwiseAbs().maxCoeff() > 8e-3) continue;
    sum -= simulation.frames[1].positions(v, 2);
    ++count;
  }
  EXPECT_NEAR(sum / count, expected, 0.03 * expected);
  EXPECT_LE(simulation.frames[1].balance.force_n, 1e-5);
}

}  // namespace simulate_moved_gel_test
}  // namespace tacipc
