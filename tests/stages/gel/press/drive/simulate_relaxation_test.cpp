// Whole motions of gels whose stress relaxes.
#include <gtest/gtest.h>

#include <cmath>

#include "stages/gel/press/drive/checkpoint.h"
#include "tests/stages/gel/press/drive/memory_store.h"
#include "tests/stages/gel/press/reference_scene.h"
#include "tests/stages/gel/press/small_scene.h"

namespace tacipc {
namespace simulate_relaxation_test {

Sensor relaxing_sensor(std::vector<Relaxation> series) {
  Sensor sensor = paper_sensor();
  sensor.material.relaxation = std::move(series);
  return sensor;
}

Simulation run(const Sensor& sensor, const PressConfig& config, const SampleSpec& sample, FrameStore* store = nullptr) {
  return simulate(sensor, block_gel(8, 0.02, 0.002), pyramid(0.003, 0.002), config, sample, "-z", ignore_progress,
                  store);
}

PressConfig precise_config(const std::string& element) {
  PressConfig config = paper_config();
  config.element = element;
  config.newton.relative_force_tolerance = 1e-6;
  config.newton.force_tolerance_n = 1e-9;
  return config;
}

SampleSpec press_and_hold(int hold_steps) {
  SampleSpec sample = press(0.3e-3, 3);
  sample.motion.push_back({.kind = PhaseKind::hold, .steps = hold_steps});
  return sample;
}

/// A weight put on within the first step: u(t)/u(∞) = 1 − g (τ_c/h)(e^{h/τ_c} − 1) e^{−t/τ_c}, τ_c = τ/g∞, at every
/// vertex alike, whatever the gel's shape.
TEST(Relaxation, AGelCreepsUnderItsWeightAsTheClosedFormSays) {
  constexpr double kPart = 0.4, kTime = 0.12, kCreepTime = kTime / (1.0 - kPart);
  for (const char* element : {"linear", "averaged_volume"}) {
    PressConfig config = precise_config(element);
    config.quasi_static = true;
    config.gravity_m_s2 = Vector3(0, 0, -10.0);
    config.start_gap_d_hat = 20.0;
    config.relative_velocity_tolerance = 1e-10;
    SampleSpec sample;
    sample.motion = {{.kind = PhaseKind::hold, .steps = 40}};
    const Simulation elastic = run(paper_sensor(), config, sample);
    const Simulation creeping = run(relaxing_sensor({{kPart, kTime}}), config, sample);
    const Positions rest = elastic.frames[0].positions, in_the_end = elastic.frames[1].positions - rest;
    const double h_s = config.time_step_s;
    for (const std::size_t f : {1, 2, 5, 15, 40}) {
      const Frame& frame = creeping.frames[f];
      const double share =
          1.0 - kPart * kCreepTime / h_s * std::expm1(h_s / kCreepTime) * std::exp(-frame.time_s / kCreepTime);
      const Positions moved = frame.positions - rest;
      EXPECT_LT((moved - share * in_the_end).norm(), 1e-3 * moved.norm()) << element << " " << f;
      EXPECT_LE(frame.balance.force_n, 1e-8);
      EXPECT_TRUE(f > 1 || share < 0.65);  // of the instantaneous modulus
      EXPECT_TRUE(f < 40 || share > 0.9);  // and nearly of the long-term one
    }
  }
}

/// Far faster than a relaxation time a gel is an elastic one of its instantaneous modulus, far slower one of its
/// long-term modulus: contact, inertia, reactions and all.
TEST(Relaxation, APressFarFasterOrSlowerThanTheGelRelaxesIsAnElasticOne) {
  for (const char* element : {"linear", "averaged_volume"}) {
    const PressConfig config = precise_config(element);
    for (const bool fast : {true, false}) {
      Sensor elastic = paper_sensor();
      if (fast) elastic.material.youngs_modulus_pa /= 0.25;
      const double time_s = fast ? 1e7 : 1e-9;
      const Simulation expected = run(elastic, config, press_and_hold(1));
      const Simulation found = run(relaxing_sensor({{0.5, time_s}, {0.25, 2.0 * time_s}}), config, press_and_hold(1));
      for (std::size_t f = 1; f < expected.frames.size(); ++f) {
        const Frame &a = expected.frames[f], &b = found.frames[f];
        EXPECT_LT((a.force_n - b.force_n).norm(), 1e-5 * a.force_n.norm()) << element << fast << f;
        EXPECT_LT((a.positions - b.positions).cwiseAbs().maxCoeff(), 2e-9) << element << fast << f;
        EXPECT_LE(b.balance.relative, 1e-5) << element << fast << f;
      }
    }
  }
}

TEST(Relaxation, AHeldPressLosesForceAndIsInBalanceThroughout) {
  PressConfig config = friction_config(0.5);
  config.element = "averaged_volume";
  config.time_step_s = 0.05;
  config.barrier_stiffness = 25.0 * *config.barrier_stiffness;  // the same κ/h²
  SampleSpec sample = press_and_hold(12);
  sample.motion.push_back({.kind = PhaseKind::shear, .steps = 3, .shift_m = {0.2e-3, 0.0, 0.0}});
  sample.motion.push_back({.kind = PhaseKind::release, .steps = 2});
  const Simulation found = run(relaxing_sensor({{0.3, 0.1}}), config, sample);
  const Simulation elastic = run(paper_sensor(), config, sample);
  const auto force = [](const Frame& frame) { return -frame.force_n.z(); };
  EXPECT_GT(force(found.frames[3]), 1.1 * force(elastic.frames[3]));
  for (std::size_t f = 4; f <= 15; ++f) EXPECT_LT(force(found.frames[f]), force(found.frames[f - 1])) << f;
  EXPECT_NEAR(force(found.frames[15]), force(elastic.frames[15]), 0.01 * force(elastic.frames[15]));
  for (std::size_t f = 1; f < found.frames.size(); ++f) EXPECT_LE(found.frames[f].balance.relative, 1e-3) << f;
  // Let go, it is still on its way back.
  const auto dent = [](const Simulation& all) {
    return (all.frames.back().positions - all.frames[0].positions).rowwise().norm().maxCoeff();
  };
  EXPECT_EQ(found.frames.back().force_n, Vector3::Zero());
  EXPECT_GT(dent(found), 10.0 * dent(elastic));
}

/// What it remembers is a force inside the gel: between object and mount there is nothing else.
TEST(Relaxation, AQuasiStaticPressIsCarriedByTheMountAlone) {
  PressConfig config = precise_config("averaged_volume");
  config.quasi_static = true;
  const Simulation found = run(relaxing_sensor({{0.5, 0.02}}), config, press_and_hold(2));
  for (std::size_t f = 1; f < found.frames.size(); ++f) {
    const Frame& frame = found.frames[f];
    EXPECT_EQ(frame.balance.inertia_n, Vector3::Zero()) << f;
    EXPECT_LT((frame.balance.mount_n + frame.force_n).norm(), 1e-5 * frame.force_n.norm()) << f;
    EXPECT_GT(frame.force_n.norm(), 0.0) << f;
  }
}

TEST(Relaxation, GoesOnFromAnyFrameToTheSameBytes) {
  const Sensor sensor = relaxing_sensor({{0.3, 0.02}, {0.2, 0.1}});
  SampleSpec sample = press_and_hold(2);
  sample.motion.push_back({.kind = PhaseKind::shear, .steps = 2, .shift_m = {0.2e-3, 0.1e-3, 0.0}});
  PressConfig config = friction_config(0.5);
  config.element = "averaged_volume";
  MemoryStore whole;
  run(sensor, config, sample, &whole);
  ASSERT_EQ(whole.saved.size(), 8u);
  for (const std::size_t known : {1, 3, 5, 7}) {
    MemoryStore rest({whole.saved.begin(), whole.saved.begin() + static_cast<std::ptrdiff_t>(known)});
    run(sensor, config, sample, &rest);
    EXPECT_TRUE(rest.saved == whole.saved) << "from " << known << " frames";
  }
  Frame frame;
  PressProgress progress;
  unpack_frame(whole.saved[3], frame, progress);
  ASSERT_EQ(progress.world.motion.viscous_pa.size(), 2u);
  EXPECT_GT(progress.world.motion.viscous_pa[0].norm(), 0.0);
  EXPECT_EQ(pack_frame(frame, progress), whole.saved[3]);
}

/// The two halves of a divided step remember as two steps of half the time step do.
TEST(Relaxation, ADividedStepRelaxesOverItsHalves) {
  const Sensor sensor = relaxing_sensor({{0.5, 0.01}});
  PressConfig config = friction_config(0.5);
  config.friction->only_at_minima = true;
  PressConfig halves = config;
  halves.time_step_s /= 2.0;
  halves.barrier_stiffness = *halves.barrier_stiffness / 4.0;  // κ/h² is that of the whole step
  const Simulation expected = run(sensor, halves, press(0.9e-3, 2));
  const Frame &first = expected.frames[1], &second = expected.frames[2];
  // Just enough for a half, too few for the whole.
  config.newton.max_iterations = std::max(first.solver.newton_iterations, second.solver.newton_iterations);
  config.max_halvings = 1;
  const Simulation divided = run(sensor, config, press(0.9e-3, 1));
  const Frame& end = divided.frames[1];
  ASSERT_EQ(end.solver.time_steps, 2);
  EXPECT_LT((end.positions - second.positions).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((end.force_n - second.force_n).norm(), 1e-9 * second.force_n.norm());
}

}  // namespace simulate_relaxation_test
}  // namespace tacipc
