// Motions with a phase in which the object is free: put down, thrown, taken again.
#include <gtest/gtest.h>

#include <cmath>

#include "common/base/error.h"
#include "common/base/log.h"
#include "tests/make_mesh.h"
#include "tests/stages/gel/press/drive/memory_store.h"
#include "tests/stages/gel/press/reference_scene.h"
#include "tests/stages/gel/press/small_scene.h"

namespace tacipc {
namespace simulate_free_test {

constexpr double kG = 9.81;

TriangleMesh block(double half_width_m, double height_m) {
  return make_box({-half_width_m, -half_width_m, 0.0}, {half_width_m, half_width_m, height_m});
}

PressConfig heavy_config(double coefficient) {
  PressConfig config = friction_config(coefficient);
  config.gravity_m_s2 = Vector3(0, 0, -kG);
  config.pair_counting.once = true;
  return config;
}

Simulation run(const TriangleMesh& object, const PressConfig& config, const SampleSpec& sample,
               FrameStore* store = nullptr) {
  return simulate(paper_sensor(), block_gel(8, 0.02, 0.002), object, config, sample, "-z", ignore_progress, store);
}

Phase free_phase(int steps, const Vector3& force_n = Vector3::Zero()) {
  return {.kind = PhaseKind::free, .steps = steps, .load_n = force_n};
}

TEST(FreeObject, ComesToRestOnTheGelUnderItsWeightAndLoad) {
  SampleSpec sample;
  sample.density_kg_m3 = 8000.0;
  sample.center_x_m = 0.4e-3;
  sample.motion = {free_phase(60), free_phase(30, {0, 0, -0.3})};
  const Simulation simulation = run(block(0.004, 0.004), heavy_config(0.5), sample);
  const double weight = 8000.0 * 0.008 * 0.008 * 0.004 * kG;
  EXPECT_NEAR(simulation.object_mass_kg * kG, weight, 1e-12);
  EXPECT_NEAR(-simulation.frames[60].force_n.z(), weight, 0.01 * weight);
  EXPECT_LT(simulation.frames[60].object_velocity_m_s.norm(), 1e-4);
  const Frame& last = simulation.frames.back();
  EXPECT_EQ(last.phase, PhaseKind::free);
  EXPECT_NEAR(-last.force_n.z(), weight + 0.3, 0.01 * weight);
  EXPECT_LT(last.gel_from_object(2, 3), simulation.frames[60].gel_from_object(2, 3));
  EXPECT_LT(last.body_strain, 1e-4);
  EXPECT_GT(last.body_strain, 0.0);
}

/// Pressed with its corner first and let go, it lies down flat.
TEST(FreeObject, LiesDownFlatWhereItIsLetGoAskew) {
  SampleSpec sample;
  sample.density_kg_m3 = 8000.0;
  sample.motion = {{.kind = PhaseKind::tilt, .steps = 3, .angle_rad = 0.05, .direction_rad = 0.5}, free_phase(80)};
  const Simulation simulation = run(block(0.004, 0.004), heavy_config(0.3), sample);
  const auto up = [](const Frame& frame) { return frame.gel_from_object(2, 2); };
  EXPECT_NEAR(up(simulation.frames[3]), std::cos(0.05), 1e-9);
  EXPECT_GT(up(simulation.frames.back()), std::cos(0.004));
  double fastest = 0.0;
  for (const Frame& frame : simulation.frames) fastest = std::max(fastest, frame.object_spin_rad_s.norm());
  EXPECT_GT(fastest, 0.2);
  EXPECT_LT(simulation.frames.back().object_spin_rad_s.norm(), 0.01 * fastest);
}

/// Thrown at the gel by a path of 5 m/s: 50 mm in one time step, 25 times the gel's thickness.
TEST(FreeObject, DoesNotGoThroughTheGelHoweverFastItIs) {
  PressConfig config = heavy_config(0.5);
  config.start_gap_d_hat = 2000.0;
  config.time_step_s = 0.01;
  SampleSpec sample;
  sample.density_kg_m3 = 1000.0;
  Phase thrown{.kind = PhaseKind::path, .steps = 1};
  thrown.points = {{0.0, Vector3::Zero(), Eigen::Quaterniond::Identity()},
                   {1e-3, Vector3(0, 0, -5e-3), Eigen::Quaterniond::Identity()}};
  sample.motion = {thrown, free_phase(12)};
  const Simulation simulation = run(block(0.003, 0.003), config, sample);
  EXPECT_NEAR(simulation.frames[1].object_velocity_m_s.z(), -5.0, 1e-9);
  EXPECT_GT(simulation.frames[1].min_gap_m.value(), 0.0);
  for (const Frame& frame : simulation.frames) {
    EXPECT_EQ(frame.intersections, 0);
    EXPECT_GT(frame.gel_from_object(2, 3), -2e-3);  // the gel is that thick
  }
  EXPECT_LT(simulation.frames[2].object_velocity_m_s.z(), -5.0);  // still on its way
  EXPECT_GT(simulation.frames[4].object_velocity_m_s.z(), -0.05);
}

TEST(FreeObject, GoesOnFromAnyFrameToTheSameBytes) {
  SampleSpec sample;
  sample.density_kg_m3 = 8000.0;
  sample.motion = {{.kind = PhaseKind::tilt, .steps = 2, .angle_rad = 0.02},
                   free_phase(4),
                   {.kind = PhaseKind::hold, .steps = 1},
                   {.kind = PhaseKind::press, .steps = 2, .depth_m = 0.2e-3},
                   free_phase(2, {0.05, 0, 0})};
  const TriangleMesh object = block(0.003, 0.004);
  MemoryStore whole;
  const Simulation simulation = run(object, heavy_config(0.5), sample, &whole);
  ASSERT_EQ(simulation.frames.size(), 12u);
  // Taken where it is, held there, and pressed on.
  EXPECT_EQ(simulation.frames[6].gel_from_object, simulation.frames[7].gel_from_object);
  EXPECT_LE(simulation.frames[7].pose_error_m, 1e-9);
  EXPECT_GT(-simulation.frames[9].force_n.z(), 0.05);
  EXPECT_GT(simulation.frames[10].object_velocity_m_s.z(), 0.0);  // let go, the gel pushes it up
  for (const std::size_t known : {2, 4, 6, 8, 11}) {
    MemoryStore rest({whole.saved.begin(), whole.saved.begin() + static_cast<std::ptrdiff_t>(known)});
    run(object, heavy_config(0.5), sample, &rest);
    EXPECT_TRUE(rest.saved == whole.saved) << "from " << known << " frames";
  }
}

/// While it yields to a load along an axis, the points that a free object moves by go with it.
TEST(FreeObject, IsLetGoWhereALoadHasMovedIt) {
  PressConfig config = heavy_config(0.5);
  SampleSpec sample;
  sample.density_kg_m3 = 8000.0;
  sample.motion = {{.kind = PhaseKind::press, .steps = 1, .load_n = Vector3(0, 0, -0.5), .free = {false, false, true}},
                   free_phase(1)};
  const Simulation simulation = run(block(0.003, 0.004), config, sample);
  const std::vector<Frame>& frames = simulation.frames;
  const auto place = [&](std::size_t frame) -> Vector3 { return frames[frame].gel_from_object.topRightCorner<3, 1>(); };
  const double h = config.time_step_s;
  ASSERT_LT(place(1).z() - place(0).z(), -10e-6);
  EXPECT_LT((frames[1].object_velocity_m_s - (place(1) - place(0)) / h).norm(), 1e-9);
  EXPECT_LT((frames[2].object_velocity_m_s - (place(2) - place(1)) / h).norm(),
            0.01 * frames[2].object_velocity_m_s.norm());
}

TEST(FreeObject, WithNeitherWeightNorLoadIsWarnedOf) {
  SampleSpec sample;
  sample.density_kg_m3 = 1000.0;
  const auto said = [&](const Vector3& gravity, const Vector3& force) {
    PressConfig config = heavy_config(0.5);
    config.gravity_m_s2 = gravity;
    sample.motion = {free_phase(1, force)};
    open_log("press", "warning");
    testing::internal::CaptureStderr();
    run(block(0.003, 0.003), config, sample);
    close_log();
    return testing::internal::GetCapturedStderr();
  };
  const Vector3 none = Vector3::Zero(), some(0, 0, -0.1);
  EXPECT_NE(said(none, none).find("neither weight nor load"), std::string::npos);
  EXPECT_EQ(said(some, none), "");
  EXPECT_EQ(said(none, some), "");
}

TEST(FreeObject, NeedsElimination) {
  PressConfig config = heavy_config(0.5);
  config.augmented_lagrangian = true;
  SampleSpec sample;
  sample.density_kg_m3 = 1000.0;
  sample.motion = {free_phase(1)};
  try {
    run(block(0.003, 0.003), config, sample);
    FAIL() << "not refused";
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("a free object needs elimination"), std::string::npos) << error.what();
  }
}

TEST(FreeObject, MustBeClosed) {
  TriangleMesh open = block(0.003, 0.003);
  open.triangles.conservativeResize(open.triangles.rows() - 1, 3);
  PressConfig config = heavy_config(0.5);
  config.pair_counting.once = false;
  SampleSpec sample;
  sample.density_kg_m3 = 1000.0;
  sample.motion = {free_phase(1)};
  EXPECT_THROW(run(open, config, sample), DataError);
}

}  // namespace simulate_free_test
}  // namespace tacipc
