// Presses into a gel whose mount gives way: F = k (holder − object) along each axis.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/error.h"
#include "stages/gel/press/drive/scene.h"
#include "tests/stages/gel/press/drive/grasp_scene.h"
#include "tests/stages/gel/press/drive/memory_store.h"
#include "tests/stages/gel/press/reference_scene.h"
#include "tests/stages/gel/press/small_scene.h"

namespace tacipc {
namespace simulate_mount_test {

using ::testing::HasSubstr;

constexpr double kAlong = 2e-4, kAcross = 4e-4;  // m/N: a fifth of a press of 0.4 mm

Sensor sensor_on(double compliance, double shear_compliance) {
  Sensor sensor = paper_sensor();
  sensor.mount = {.compliance_m_per_n = compliance, .shear_compliance_m_per_n = shear_compliance};
  return sensor;
}

/// Where the gel ends does not depend on the way there: no inertia, no friction.
PressConfig exact_config() {
  PressConfig config = paper_config();
  config.quasi_static = true;
  config.linear_solver = LinearSolverKind::direct;
  config.relative_velocity_tolerance = 1e-8;
  config.newton.relative_force_tolerance = 1e-10;
  config.newton.force_tolerance_n = 1e-11;
  return config;
}

Simulation run(const Sensor& sensor, const PressConfig& config, const SampleSpec& sample, FrameStore* store = nullptr) {
  return simulate(sensor, block_gel(8, 0.02, 0.002), pyramid(0.003, 0.002), config, sample, "-z", ignore_progress,
                  store);
}

/// Downwards since frame 0.
double way_of(const Matrix4& pose, const Simulation& simulation) {
  return simulation.frames[0].gel_from_object(2, 3) - pose(2, 3);
}

Vector3 lag_of(const Frame& frame) { return (frame.gel_from_object - frame.holder_pose).topRightCorner<3, 1>(); }

SampleSpec press_shear_release() {
  SampleSpec sample = press(0.4e-3, 3);
  sample.motion.push_back({.kind = PhaseKind::shear, .steps = 3, .shift_m = {0.2e-3, 0.1e-3, 0.0}});
  sample.motion.push_back({.kind = PhaseKind::twist, .steps = 2, .angle_rad = 0.1});
  sample.motion.push_back({.kind = PhaseKind::release, .steps = 3});
  return sample;
}

TEST(Mount, APressIsARigidOneToTheDepthThatItsForceLeaves) {
  const PressConfig config = exact_config();
  const Simulation soft = run(sensor_on(kAlong, 0.0), config, press(0.4e-3, 4)),
                   rigid = run(sensor_on(0.0, 0.0), config, press(0.4e-3, 4));
  EXPECT_TRUE(soft.mount_gives_way);
  EXPECT_FALSE(rigid.mount_gives_way);
  const double start_gap_m = config.start_gap_d_hat * soft.d_hat_m;
  for (std::size_t f = 1; f < soft.frames.size(); ++f) {
    const Frame& frame = soft.frames[f];
    EXPECT_EQ(frame.holder_pose, rigid.frames[f].gel_from_object);
    const double force_n = -frame.force_n.z(), way_m = way_of(frame.gel_from_object, soft);
    EXPECT_NEAR(way_m, way_of(frame.holder_pose, soft) - kAlong * force_n, 1e-6 * way_m) << f;
    const Simulation there = run(sensor_on(0.0, 0.0), config, press(way_m - start_gap_m, 1));
    EXPECT_NEAR(force_n, -there.frames[1].force_n.z(), 1e-6 * force_n) << f;
  }
  EXPECT_GT(lag_of(soft.frames.back()).z(), 0.05e-3);
}

TEST(Mount, LagsAlongEachAxisByItsForce) {
  PressConfig config = friction_config(0.8);
  config.newton.relative_force_tolerance = 1e-7;
  config.newton.force_tolerance_n = 1e-9;
  config.relative_velocity_tolerance = 1e-5;
  for (const bool quasi_static : {false, true}) {
    config.quasi_static = quasi_static;
    const Simulation found = run(sensor_on(kAlong, kAcross), config, press_shear_release());
    for (const Frame& frame : found.frames) {
      const Vector3 expected = -Vector3(kAcross, kAcross, kAlong).cwiseProduct(frame.force_n);
      EXPECT_LT((lag_of(frame) - expected).norm(), 1e-5 * expected.norm() + 1e-12) << frame.time_s;
      EXPECT_EQ((Matrix3(frame.gel_from_object.topLeftCorner<3, 3>())),
                (Matrix3(frame.holder_pose.topLeftCorner<3, 3>())));
    }
    EXPECT_GT(lag_of(found.frames[6]).head<2>().norm(), 0.02e-3);
    EXPECT_LT(lag_of(found.frames[6]).x(), 0.0);  // dragged along +x, it is behind
    // What stands before the holder's way back is the way there.
    const Frame &in = found.frames[3], &out = found.frames.back();
    EXPECT_GT(-in.force_n.z(), 0.1);
    EXPECT_EQ(out.force_n, Vector3::Zero());
    EXPECT_LT(lag_of(out).norm(), 1e-12);
    EXPECT_NEAR(out.holder_pose(2, 3), found.frames[0].gel_from_object(2, 3), 1e-15);
  }
}

/// Under a load the force is given, so that the mount changes nothing but where the holder is.
TEST(Mount, ALoadPressesAsOnARigidOne) {
  const PressConfig config = exact_config();
  SampleSpec sample;
  sample.density_kg_m3 = 8000.0;
  sample.motion = {{.kind = PhaseKind::press,
                    .steps = 2,
                    .substeps = 3,
                    .load_n = Vector3(0, 0, -0.5),
                    .free = {false, false, true}},
                   {.kind = PhaseKind::hold, .steps = 2}};
  const Simulation rigid = run(sensor_on(0.0, 0.0), config, sample);
  sample.motion.push_back({.kind = PhaseKind::release, .steps = 2});
  const Simulation soft = run(sensor_on(kAlong, 0.0), config, sample);
  for (std::size_t f = 0; f < rigid.frames.size(); ++f) {
    EXPECT_EQ(soft.frames[f].gel_from_object, rigid.frames[f].gel_from_object) << f;
    EXPECT_NEAR(lag_of(soft.frames[f]).z(), -kAlong * soft.frames[f].force_n.z(), 1e-15) << f;
  }
  EXPECT_GT(lag_of(soft.frames[4]).z(), 0.5e-4);
  // Raised from where it is, by half of the way back of the holder.
  const Frame &held = soft.frames[4], &half = soft.frames[5], &free = soft.frames[6];
  EXPECT_NEAR(half.holder_pose(2, 3), 0.5 * (held.holder_pose(2, 3) + free.holder_pose(2, 3)), 1e-12);
  EXPECT_NEAR(lag_of(half).z(), -kAlong * half.force_n.z(), 1e-10);
  EXPECT_LT(-half.force_n.z(), -held.force_n.z());
  EXPECT_EQ(free.force_n, Vector3::Zero());
}

TEST(Mount, GoesOnFromAnyFrameToTheSameBytes) {
  const PressConfig config = friction_config(0.5);
  const Sensor sensor = sensor_on(kAlong, kAcross);
  MemoryStore whole;
  run(sensor, config, press_shear_release(), &whole);
  ASSERT_EQ(whole.saved.size(), 12u);
  for (const std::size_t known : {1, 3, 5, 8, 10}) {
    MemoryStore rest({whole.saved.begin(), whole.saved.begin() + static_cast<std::ptrdiff_t>(known)});
    run(sensor, config, press_shear_release(), &rest);
    EXPECT_TRUE(rest.saved == whole.saved) << "from " << known << " frames";
  }
}

TEST(Mount, IsRefusedWhereNothingTakesItIntoAccount) {
  const Sensor sensor = sensor_on(0.0, kAcross);
  const auto why = [](auto&& press) -> std::string {
    try {
      press();
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  };
  PressConfig lagrangian = paper_config();
  lagrangian.augmented_lagrangian = true;
  EXPECT_THAT(why([&] { run(sensor, lagrangian, press(0.1e-3, 1)); }), HasSubstr("a mount that gives way needs elimi"));
  SampleSpec free;
  free.density_kg_m3 = 1000.0;
  free.motion = {{.kind = PhaseKind::free, .steps = 1, .load_n = Vector3::Zero()}};
  EXPECT_THAT(why([&] { run(sensor, paper_config(), free); }), HasSubstr("not to one that is free"));
  EXPECT_THAT(why([&] {
                grasp(sensor, block_gel(6, 0.02, 0.002), centered_box({4e-3, 4e-3, 4e-3}), grasp_config(0.8),
                      grasp_of(0.05, {close_phase(1, 1.0)}), ignore_progress);
              }),
              HasSubstr("for single presses, not for grasps and scenes"));
  SceneSpec scene;
  scene.bodies.push_back({.name = "gel", .kind = BodyKind::gel, .world_from_body = Matrix4::Identity()});
  const std::vector<SceneBody> bodies{{.tets = block_gel(6, 0.02, 0.002), .material = sensor.material}};
  EXPECT_THAT(why([&] { run_scene(sensor, bodies, grasp_config(0.8), scene, ignore_progress); }),
              HasSubstr("for single presses, not for grasps and scenes"));
}

}  // namespace simulate_mount_test
}  // namespace tacipc
