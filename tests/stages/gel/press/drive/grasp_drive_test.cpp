// Drives with mass and damping, one for both fingers or one for each, against mechanics of points.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "common/base/log.h"
#include "tests/stages/gel/press/drive/grasp_scene.h"

namespace tacipc {
namespace grasp_drive_test {

using ::testing::HasSubstr;

constexpr double kMass_kg = 0.05, kGrip_n = 1.0;
const TriangleMesh kBox = centered_box({4e-3, 4e-3, 4e-3});

double grip_n(const GraspFrame& frame) { return 0.5 * (frame.grip_n(0) + frame.grip_n(1)); }

/// A box with a smaller, blunt knob on the side of the right finger.
TriangleMesh box_with_knob() {
  const double b = 4e-3, k = 1.5e-3, top = 6e-3;
  TriangleMesh mesh;
  mesh.positions.resize(12, 3);
  mesh.positions << -b, -b, -b, -b, b, -b, -b, b, b, -b, -b, b,  // left face
      b, -b, -b, b, b, -b, b, b, b, b, -b, b,                    // where the knob begins
      top, -k, -k, top, k, -k, top, k, k, top, -k, k;            // its end
  mesh.triangles.resize(20, 3);
  Eigen::Index t = 0;
  mesh.triangles.row(t++) << 0, 2, 1;
  mesh.triangles.row(t++) << 0, 3, 2;
  for (const int ring : {0, 4}) {
    for (int i = 0; i < 4; ++i) {
      const int a = ring + i, c = ring + (i + 1) % 4;
      mesh.triangles.row(t++) << a, c, a + 4;
      mesh.triangles.row(t++) << c, c + 4, a + 4;
    }
  }
  mesh.triangles.row(t++) << 8, 9, 10;
  mesh.triangles.row(t++) << 8, 10, 11;
  return mesh;
}

TEST(GraspDrive, IsInBalanceAfterEveryTimeStepAndRestsAtItsForce) {
  for (const bool each : {false, true}) {
    GraspSpec spec = grasp_of(kMass_kg, {close_phase(10, kGrip_n), hold_phase(40)});
    spec.mount = {.mass_kg = 0.5, .damping_n_s_m = 40.0};
    spec.drive_each = each;
    const Grasp grasp = run_grasp(kBox, grasp_config(0.8), spec);
    for (std::size_t f = 1; f < grasp.frames.size(); ++f) {
      const GraspFrame &before = grasp.frames[f - 1], &frame = grasp.frames[f];
      if (f == grasp.freed_frame) continue;  // has several time steps
      for (const std::size_t side : {0, 1}) {
        const FingerDrive& drive = frame.drives[side];
        EXPECT_NEAR(drive.closed_m - before.drives[side].closed_m, 0.01 * drive.velocity_m_s, 1e-12);
        const double rate = (drive.velocity_m_s - before.drives[side].velocity_m_s) / 0.01;
        const double off_n = 0.5 * rate + 40.0 * drive.velocity_m_s + frame.grip_n(side) - drive.force_n;
        const bool as_fast_as_it_may = drive.velocity_m_s > 0.0199;
        EXPECT_TRUE(as_fast_as_it_may || std::abs(off_n) < 0.021 * std::max(drive.force_n, frame.grip_n(side)))
            << each << " " << f << ": " << off_n;
      }
    }
    EXPECT_NEAR(grasp.frames.back().grip_n(0), kGrip_n, 5e-3 * kGrip_n) << each;
    EXPECT_NEAR(grasp.frames.back().grip_n(1), kGrip_n, 5e-3 * kGrip_n) << each;
    EXPECT_EQ(grasp.frames.back().drives[0].force_n, kGrip_n);
    EXPECT_EQ(grasp.outcome, GraspOutcome::lifted);
  }
}

/// A drive that is pushed off its balance, on a gel whose stiffness k its grips tell: (m/h² + c/h + k) x = (2 m/h² +
/// c/h) x' − m/h² x'' of the last two steps, the damped oscillator with the implicit scheme's own damping.
TEST(GraspDrive, SwingsOnTheGelAsADampedOscillator) {
  constexpr double kStep_s = 1e-3, kDriveMass_kg = 2.0, kDamping = 40.0;
  PressConfig config = grasp_config(0.8);
  config.time_step_s = kStep_s;
  GraspSpec spec =
      grasp_of(kMass_kg, {close_phase(60, kGrip_n), hold_phase(40), release_phase(1, 1e-6), hold_phase(80)});
  spec.gravity_m_s2.setZero();
  spec.mount = {.mass_kg = kDriveMass_kg, .damping_n_s_m = kDamping};
  const Grasp grasp = run_grasp(kBox, config, spec);
  const std::size_t begin = 101, end = grasp.frames.size();
  const double wanted_n = grasp.frames[begin].drives[0].force_n;
  EXPECT_EQ(wanted_n, grasp.frames.back().drives[0].force_n);
  // grip = wanted + k × (way − rest) by least squares.
  Eigen::MatrixXd lines(end - begin, 2);
  Eigen::VectorXd grips(end - begin);
  for (std::size_t f = begin; f < end; ++f) {
    const auto row = static_cast<Eigen::Index>(f - begin);
    lines.row(row) << grasp.frames[f].drives[0].closed_m, 1.0;
    grips[row] = grip_n(grasp.frames[f]) - wanted_n;
  }
  const Eigen::Vector2d line = lines.colPivHouseholderQr().solve(grips);
  const double k = line[0], rest_m = -line[1] / k;
  EXPECT_GT(grips.maxCoeff() - grips.minCoeff(), 0.1);
  // x = p x' + q x'' by least squares.
  Eigen::Matrix2d A = Eigen::Matrix2d::Zero();
  Eigen::Vector2d b = Eigen::Vector2d::Zero();
  const auto off = [&](std::size_t f) { return grasp.frames[f].drives[0].closed_m - rest_m; };
  for (std::size_t f = begin + 2; f < end; ++f) {
    const Eigen::Vector2d row(off(f - 1), off(f - 2));
    A += row * row.transpose();
    b += row * off(f);
  }
  const Eigen::Vector2d fit = A.inverse() * b;
  const auto decay = [](double q) { return -0.5 * std::log(-q); };                           // in a step
  const auto angle = [](double p, double q) { return std::acos(0.5 * p / std::sqrt(-q)); };  // 2π step/period
  const double all = kDriveMass_kg + kStep_s * kDamping + kStep_s * kStep_s * k;
  const double p = (2.0 * kDriveMass_kg + kStep_s * kDamping) / all, q = -kDriveMass_kg / all;
  EXPECT_NEAR(angle(fit[0], fit[1]), angle(p, q), 0.04 * angle(p, q));
  EXPECT_NEAR(decay(fit[1]), decay(q), 0.06 * decay(q));
}

/// What is of another shape on either side is pressed alike by drives of their own, and by one drive is not.
TEST(GraspDrive, EachPressesBothSidesAlike) {
  const TriangleMesh object = box_with_knob();
  const auto gripped = [&](bool each, double mass_kg, double damping, std::string& said) {
    GraspSpec spec = grasp_of(kMass_kg, {close_phase(5, kGrip_n), hold_phase(10), lift_phase(5, 1e-3), hold_phase(5)});
    spec.drive_each = each;
    spec.mount = {.mass_kg = mass_kg, .damping_n_s_m = damping};
    open_log("press", "warning");
    testing::internal::CaptureStderr();
    Grasp grasp = run_grasp(object, grasp_config(0.8), spec);
    close_log();
    said = testing::internal::GetCapturedStderr();
    return grasp;
  };
  std::string said;
  const Grasp one = gripped(false, 0.0, 0.0, said);
  EXPECT_THAT(said, HasSubstr("fingers.drive: each"));
  const GraspFrame& freed = one.frames[one.freed_frame];
  EXPECT_GT(freed.grip_n(0), 1.2 * freed.grip_n(1));
  for (const double mass_kg : {0.0, 0.1}) {
    const Grasp each = gripped(true, mass_kg, 200.0 * mass_kg, said);
    EXPECT_EQ(said, "") << mass_kg;
    EXPECT_EQ(each.outcome, GraspOutcome::lifted) << mass_kg;
    for (std::size_t f = each.freed_frame; f < each.frames.size(); ++f) {
      const double left = each.frames[f].grip_n(0), right = each.frames[f].grip_n(1);
      EXPECT_NEAR(left, right, 0.02 * kGrip_n) << mass_kg << " " << f;
    }
    // The knob is pressed in farther than the face. Later, without damping, both drift with the object.
    const auto& drives = each.frames[each.freed_frame].drives;
    EXPECT_GT(drives[1].closed_m, drives[0].closed_m + 5e-5) << mass_kg;
  }
}

/// With drives of their own nothing but these holds the object along their axis: turned upright, object and drives go
/// down as (M + 2 m) a = M g − 2 c v.
TEST(GraspDrive, EachLetsTheObjectFloatAlongItsAxis) {
  constexpr double kDriveMass_kg = 0.1, kDamping = 60.0;
  GraspSpec spec = grasp_of(
      kMass_kg, {close_phase(5, 2.0), hold_phase(5), turn_phase(20, 0.5 * std::numbers::pi, 1), hold_phase(20)});
  spec.drive_each = true;
  spec.mount = {.mass_kg = kDriveMass_kg, .damping_n_s_m = kDamping};
  const Grasp grasp = run_grasp(kBox, grasp_config(0.8), spec);
  const double terminal = kMass_kg * kG / (2.0 * kDamping);
  const GraspFrame& last = grasp.frames.back();
  EXPECT_NEAR(last.velocity_m_s.z(), -terminal, 0.02 * terminal);
  for (const std::size_t side : {0, 1})
    EXPECT_NEAR(std::abs(last.drives[side].velocity_m_s), terminal, 0.02 * terminal);
  // Both hold it by the wanted force, but for what their damping takes.
  EXPECT_NEAR(grip_n(last), 2.0, 0.04);
  EXPECT_NEAR(std::abs(last.grip_n(0) - last.grip_n(1)), kMass_kg * kG, 0.03 * kMass_kg * kG);
  // Under gravity across the axis it stays.
  GraspSpec upright = spec;
  upright.motion = {close_phase(5, 2.0), hold_phase(30)};
  const Grasp held = run_grasp(kBox, grasp_config(0.8), upright);
  EXPECT_LT(std::abs((held.frames.back().world_from_object - held.frames[5].world_from_object)(0, 3)), 2e-6);
}

TEST(GraspDrive, GoesOnFromAnyFrameToTheSameBytes) {
  GraspSpec spec = grasp_of(kMass_kg, {{.kind = PhaseKind::close, .steps = 3, .substeps = 2, .force_n = 0.8},
                                       lift_phase(2, 1e-3),
                                       turn_phase(2, 0.3, 1),
                                       close_phase(1, 1.2),
                                       close_to_phase(1, 9.9e-3),
                                       hold_phase(1),
                                       close_phase(1, 1.0),
                                       release_phase(1, 5e-4)});
  spec.drive_each = true;
  spec.mount = {.mass_kg = 0.1, .damping_n_s_m = 50.0};
  MemoryStore whole;
  run_grasp(box_with_knob(), grasp_config(0.8), spec, &whole);
  ASSERT_EQ(whole.saved.size(), 13u);
  for (const std::size_t known : {2, 4, 5, 7, 9, 10, 11}) {
    MemoryStore rest({whole.saved.begin(), whole.saved.begin() + static_cast<std::ptrdiff_t>(known)});
    run_grasp(box_with_knob(), grasp_config(0.8), spec, &rest);
    EXPECT_TRUE(rest.saved == whole.saved) << "from " << known << " frames";
  }
}

}  // namespace grasp_drive_test
}  // namespace tacipc
