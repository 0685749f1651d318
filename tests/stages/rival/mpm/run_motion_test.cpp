// Motions of a ball over a small gel: depths, drags, turns, and what is refused.
#include "stages/rival/mpm/run_motion.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "common/base/error.h"
#include "tests/make_mesh.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace run_motion_test {

/// A gel of 6 × 6 × 1.2 mm.
Sensor small_sensor() {
  Sensor sensor;
  sensor.gel = {.outline = GelShape::Outline::rectangle, .width_m = 6e-3, .height_m = 6e-3, .thickness_m = 1.2e-3};
  sensor.material = {.law = "neo_hookean", .density_kg_m3 = 1010, .youngs_modulus_pa = 1.23e5, .poissons_ratio = 0.43};
  return sensor;
}

MpmConfig coarse() {
  MpmConfig config;
  config.gel = {.spacing_m = 0.2e-3};
  config.grid_spacing_m = 0.4e-3;
  config.courant = 0.4;
  config.object = {.samples_per_m2 = 3000 / 16e-6,
                   .mass_ratio = 50,
                   .press_speed_m_s = 0.4,
                   .move_speed_m_s = 0.4,
                   .start_gap_m = 1e-3};
  config.depth_of_gel = true;
  config.check_every = 2;
  config.hold_frame_s = 1e-4;
  return config;
}

/// A block of 2 × 2 × 1 mm with its lower face at z = 0.
TriangleMesh brick() { return make_box({-1e-3, -1e-3, 0.0}, {1e-3, 1e-3, 1e-3}); }

Phase press(double depth_m, int steps) { return {.kind = PhaseKind::press, .steps = steps, .depth_m = depth_m}; }

MpmRun run(const MpmConfig& config, const std::vector<Phase>& motion, double speed_factor = 1.0) {
  SampleSpec sample;
  sample.motion = motion;
  const MpmScene scene = make_scene(config, small_sensor(), sample, brick(), "-z");
  return run_motion(scene, speed_factor, [](int, int, int, double) {});
}

TEST(RunMotion, PressesUntilTheFrontIsThatDeep) {
  const MpmRun done = run(coarse(), {press(0.3e-3, 3)});
  ASSERT_EQ(done.frames.size(), 4u);
  EXPECT_EQ(done.frames[0].gel_depth_m, 0.0);
  EXPECT_EQ(done.frames[0].phase, PhaseKind::reference);
  EXPECT_NEAR(done.frames[0].object_depth_m, -1e-3, 1e-12);
  for (std::size_t f = 1; f < 4; ++f) {
    const MpmFrame& frame = done.frames[f];
    EXPECT_GE(frame.gel_depth_m, 1e-4 * static_cast<double>(f));
    EXPECT_LT(frame.gel_depth_m, 1e-4 * static_cast<double>(f) + 0.03e-3);
    EXPECT_EQ(frame.phase, PhaseKind::press);
    EXPECT_LT(frame.momentum_kg_m_s.z(), 0.0) << "downwards";
    EXPECT_NEAR(frame.front_m.col(2).minCoeff(), -frame.gel_depth_m, 1e-12);
  }
  EXPECT_NEAR(done.object_speed_m_s, 0.4, 1e-9);
  EXPECT_NEAR(done.frames[3].time_s, done.frames[3].steps * 0.4 * 0.4e-3 / 18.62075, 1e-8);
}

TEST(RunMotion, AFrameIsTheFirstLookThatLacksAtMostWhatItsCriterionAllows) {
  MpmConfig config = coarse();
  config.check_every = 1;
  int last_steps = std::numeric_limits<int>::max();
  for (const double within_m : {0.0, 1e-6, 1e-5, 1e-4}) {
    config.frame_within_m = within_m;
    const MpmFrame frame = run(config, {press(0.3e-3, 1)}).frames[1];
    EXPECT_GE(frame.gel_depth_m, 0.3e-3 - within_m);
    EXPECT_LT(frame.gel_depth_m, 0.3e-3 - within_m + 0.01e-3) << "a step later than the first that is deep enough";
    EXPECT_LE(frame.steps, last_steps);
    last_steps = frame.steps;
  }
  // Frames 0.05 mm apart, of which each may lack 0.1 mm: each is a look of its own, as a program that saves one a step
  // has it.
  const MpmRun many = run(config, {press(0.3e-3, 6)});
  for (std::size_t f = 1; f < many.frames.size(); ++f) EXPECT_GT(many.frames[f].steps, many.frames[f - 1].steps) << f;
}

TEST(RunMotion, TheSpeedOfATurnIsThatOfTheFastestPoint) {
  SampleSpec sample;
  sample.motion = {press(0.1e-3, 1), {.kind = PhaseKind::twist, .steps = 1, .angle_rad = 0.1}};
  // An octahedron: four corners 2 mm from the axis, in a box whose own are 2.83 mm away.
  const double r = 2e-3, h = 1e-3;
  const TriangleMesh octahedron =
      make_mesh({{r, 0, h}, {0, r, h}, {-r, 0, h}, {0, -r, h}, {0, 0, 0}, {0, 0, 2 * h}},
                {{0, 1, 5}, {1, 2, 5}, {2, 3, 5}, {3, 0, 5}, {1, 0, 4}, {2, 1, 4}, {3, 2, 4}, {0, 3, 4}});
  MpmConfig config = coarse();
  config.object.press_speed_m_s = 0.1;
  const MpmScene scene = make_scene(config, small_sensor(), sample, octahedron, "-z");
  const MpmRun done = run_motion(scene, 1.0, [](int, int, int, double) {});
  EXPECT_NEAR(done.object_speed_m_s, 0.4, 0.01) << "whole steps take a little longer";
  const double took_s = done.frames[2].time_s - done.frames[1].time_s;
  EXPECT_NEAR(took_s, 0.1 * 2e-3 / 0.4, 0.02 * took_s);
}

TEST(RunMotion, PointsCoverTheWholeSurfaceEvenly) {
  MpmConfig config = coarse();
  config.object.samples_per_m2 = 60e6;
  SampleSpec sample;
  sample.motion = {press(0.1e-3, 1)};
  const MpmScene scene = make_scene(config, small_sensor(), sample, brick(), "-z");
  EXPECT_NEAR(static_cast<double>(scene.object_points_m.rows()), 960.0, 1.0) << "60 per mm2 of 16 mm2";
  EXPECT_NEAR(scene.points_per_m2(), 60e6, 0.1e6);
}

TEST(RunMotion, OrUntilTheObjectIs) {
  MpmConfig config = coarse();
  config.depth_of_gel = false;
  const MpmRun done = run(config, {press(0.2e-3, 2), {.kind = PhaseKind::release, .steps = 1, .height_m = 0.5e-3}});
  EXPECT_NEAR(done.frames[1].object_depth_m, -0.4e-3, 1e-12) << "half the way from 1 mm above to 0.2 mm below";
  EXPECT_NEAR(done.frames[2].object_depth_m, 0.2e-3, 1e-12);
  EXPECT_NEAR(done.frames[3].object_depth_m, -0.5e-3, 1e-12);
  EXPECT_GT(done.frames[2].gel_depth_m, 0.2e-3) << "the object's velocity reaches ahead of it";
}

TEST(RunMotion, AHighObjectApproaches) {
  MpmConfig config = coarse();
  config.depth_of_gel = false;
  config.object.start_gap_m = 4e-3;
  EXPECT_EQ(run(config, {press(0.1e-3, 2)}).frames[1].phase, PhaseKind::approach);
}

TEST(RunMotion, DragsAndTurnsTheFrontAlong) {
  const MpmRun dragged =
      run(coarse(), {press(0.3e-3, 1), {.kind = PhaseKind::shear, .steps = 4, .shift_m = {0.0, 0.2e-3, 0.0}}});
  const Positions way = dragged.frames[5].front_m - dragged.frames[1].front_m;
  EXPECT_GT(way.col(1).maxCoeff(), 0.12e-3);
  EXPECT_LT(way.col(1).maxCoeff(), 0.25e-3);
  EXPECT_LT(way.col(0).cwiseAbs().maxCoeff(), 0.06e-3);
  EXPECT_NEAR(dragged.frames[5].gel_from_object(1, 3) - dragged.frames[1].gel_from_object(1, 3), 0.2e-3, 1e-15);

  const MpmRun turned = run(coarse(), {press(0.3e-3, 1), {.kind = PhaseKind::twist, .steps = 2, .angle_rad = 0.15}});
  // Under the block, curl of the way is twice the angle or less.
  const Positions &before = turned.frames[1].front_m, &after = turned.frames[3].front_m;
  double moment = 0.0, arm = 0.0;
  for (Eigen::Index c = 0; c < before.rows(); ++c) {
    if (before.row(c).head<2>().cwiseAbs().maxCoeff() > 0.7e-3) continue;
    const Vector3 r = before.row(c), u = after.row(c) - before.row(c);
    moment += r.x() * u.y() - r.y() * u.x();
    arm += r.head<2>().squaredNorm();
  }
  EXPECT_GT(moment / arm, 0.09);
  EXPECT_LT(moment / arm, 0.16);
}

TEST(RunMotion, HoldLastsAsLongAsConfigured) {
  const MpmRun done = run(coarse(), {press(0.1e-3, 1), {.kind = PhaseKind::hold, .steps = 3}});
  const double step_s = done.frames[4].time_s / done.frames[4].steps;
  EXPECT_NEAR(done.frames[4].time_s - done.frames[1].time_s, 3e-4, 3.01 * step_s);
  EXPECT_EQ(done.frames[4].gel_from_object, done.frames[1].gel_from_object);
}

TEST(RunMotion, HalfTheSpeedTakesTwiceTheSteps) {
  const std::vector<Phase> motion{press(0.2e-3, 1), {.kind = PhaseKind::shear, .steps = 1, .shift_m = {0.2e-3, 0, 0}}};
  const MpmRun fast = run(coarse(), motion), slow = run(coarse(), motion, 0.5);
  EXPECT_NEAR(
      static_cast<double>(slow.frames[2].steps - slow.frames[1].steps) / (fast.frames[2].steps - fast.frames[1].steps),
      2.0, 0.02);
  EXPECT_NEAR(slow.object_speed_m_s, 0.2, 1e-9);
}

TEST(RunMotion, SaysWhatItCannotDo) {
  Phase load{.kind = PhaseKind::press, .steps = 1, .load_n = Vector3(0, 0, -1)};
  EXPECT_EQ(message_of<UsageError>([&] { run(coarse(), {load}); }),
            "the sample loads the object with a force; mpm moves it by prescribed motions only");
  EXPECT_EQ(message_of<DataError>([] { run(coarse(), {press(1.2e-3, 1)}); }),
            "depth 1.2 mm is not less than the gel's thickness 1.2 mm");
  EXPECT_THAT(message_of<DataError>([] {
                run(coarse(), {press(0.2e-3, 1), press(0.1e-3, 1)});
              }),
              ::testing::StartsWith("a press to 0.1 mm begins where the gel is 0.2"));
  MpmConfig feather = coarse();
  feather.object.samples_per_m2 = 1e-3;
  feather.object.mass_ratio = 1e-3;
  EXPECT_THAT(message_of<SolverError>([&] { run(feather, {press(0.3e-3, 1)}); }),
              ::testing::StartsWith("the object is 1.2"));
}

}  // namespace run_motion_test
}  // namespace tacipc
