// Grasps of boxes and bars by two small gels, against statics.
#include "stages/gel/press/drive/grasp.h"

#include <gmock/gmock.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/base/error.h"
#include "common/base/log.h"
#include "tests/scratch_folder.h"
#include "tests/stages/gel/press/drive/grasp_scene.h"

namespace tacipc {
namespace grasp_test {

using ::testing::HasSubstr;

constexpr double kMass_kg = 0.05, kGrip_n = 1.0;
const TriangleMesh kBox = centered_box({4e-3, 4e-3, 4e-3});
const TriangleMesh kBar = centered_box({4e-3, 30e-3, 4e-3});

double carried_n(const GraspFrame& frame) { return -(frame.force_on_finger_n[0] + frame.force_on_finger_n[1]).z(); }
double grip_n(const GraspFrame& frame) { return 0.5 * (frame.grip_n(0) + frame.grip_n(1)); }
Vector3 hand_of(const GraspFrame& frame) { return frame.world_from_hand.topRightCorner<3, 1>(); }
double fingers_apart_m(const GraspFrame& frame) {
  return (frame.world_from_finger[1] - frame.world_from_finger[0])(0, 3);
}

TEST(Grasp, CarriesTheWeightByFrictionOfBothFingersAlike) {
  const std::vector<GraspPhase> motion{close_phase(3, kGrip_n), hold_phase(20), lift_phase(10, 2e-3), hold_phase(10)};
  const Grasp grasp = run_grasp(kBox, grasp_config(0.8), grasp_of(kMass_kg, motion));
  const double weight = kMass_kg * kG;
  ASSERT_EQ(grasp.frames.size(), 44u);
  EXPECT_NEAR(grasp.mass_kg, kMass_kg, 1e-12);
  EXPECT_NEAR(grasp.weight_n, weight, 1e-9);
  EXPECT_NEAR(grasp.grip_n, kGrip_n, 0.02 * kGrip_n);
  EXPECT_EQ(grasp.outcome, GraspOutcome::lifted);
  EXPECT_EQ(grasp.judged_frame, 43u);
  for (const std::size_t f : {23u, 43u}) {
    const GraspFrame& at_rest = grasp.frames[f];
    EXPECT_NEAR(carried_n(at_rest), weight, 1e-3 * weight);
    EXPECT_NEAR(at_rest.force_on_finger_n[0].z(), at_rest.force_on_finger_n[1].z(), 5e-3 * weight);
    EXPECT_NEAR(at_rest.force_on_finger_n[0].x(), -at_rest.force_on_finger_n[1].x(), 1e-3 * kGrip_n);
  }
  // While the fingers close the grip grows to what is asked for, and is kept from then on.
  for (std::size_t f = 0; f < grasp.frames.size(); ++f) {
    EXPECT_LE(grip_n(grasp.frames[f]), 1.05 * kGrip_n) << f;
    if (f >= 3) {
      EXPECT_GE(grip_n(grasp.frames[f]), 0.95 * kGrip_n) << f;
    }
  }
  // It goes up with the hand.
  const GraspFrame &before = grasp.frames[23], &after = grasp.frames.back();
  EXPECT_NEAR((hand_of(after) - hand_of(before)).z(), 2e-3, 1e-12);
  EXPECT_NEAR((after.world_from_object - before.world_from_object)(2, 3), 2e-3, 0.1e-3);
  EXPECT_LT(after.slip_m, 0.1e-3);
  EXPECT_LT(after.turn_rad, 2e-3);
}

TEST(Grasp, FrameZeroIsEachGelAtRest) {
  const TetMesh gel = block_gel(6, 0.02, 0.002);
  const Grasp grasp =
      run_grasp(kBox, grasp_config(0.8), grasp_of(kMass_kg, {close_phase(2, kGrip_n), hold_phase(2)}), nullptr, gel);
  for (const Simulation& finger : grasp.fingers) {
    ASSERT_EQ(finger.frames.size(), grasp.frames.size());
    EXPECT_TRUE(finger.frames[0].positions == gel.positions);
    EXPECT_EQ(finger.frames[0].phase, PhaseKind::reference);
    EXPECT_EQ(finger.frames[0].force_n, Vector3::Zero());
    EXPECT_TRUE(finger.frames[0].normal_force_n.isZero(0.0));
  }
}

/// What a finger's folder holds is what the world's poses say, seen from its own frame.
TEST(Grasp, EachFingerSeesTheObjectInItsOwnFrame) {
  const TetMesh gel = block_gel(6, 0.02, 0.002);
  const std::vector<GraspPhase> motion{close_phase(3, kGrip_n), hold_phase(3), lift_phase(5, 2e-3)};
  const Grasp grasp = run_grasp(kBox, grasp_config(0.8), grasp_of(kMass_kg, motion), nullptr, gel);
  for (std::size_t f = 0; f < grasp.frames.size(); ++f) {
    const GraspFrame& frame = grasp.frames[f];
    for (std::size_t side = 0; side < 2; ++side) {
      const Frame& own = grasp.fingers[side].frames[f];
      const Matrix4& world_from_finger = frame.world_from_finger[side];
      EXPECT_LT((world_from_finger * own.gel_from_object - frame.world_from_object).cwiseAbs().maxCoeff(), 1e-12);
      const Matrix3 R = world_from_finger.topLeftCorner<3, 3>();
      EXPECT_LT((R * own.force_n - frame.force_on_finger_n[side]).norm(), 1e-12);
      EXPECT_LT((R * own.object_velocity_m_s - frame.velocity_m_s).norm(), 1e-12);
      EXPECT_LT((R.transpose() * R - Matrix3::Identity()).norm(), 1e-15);
      EXPECT_NEAR(R.determinant(), 1.0, 1e-15);
      // Its back is where the mount has it.
      for (const int v : gel.vertices(BoundaryTag::glued))
        EXPECT_LT((own.positions.row(v) - gel.positions.row(v)).norm(), 1e-12);
    }
    // Its front looks along its z: x of the world for the left one, −x for the right one.
    EXPECT_EQ(Vector3(frame.world_from_finger[0].col(2).head<3>()), Vector3::UnitX());
    EXPECT_EQ(Vector3(frame.world_from_finger[1].col(2).head<3>()), Vector3(-Vector3::UnitX()));
    EXPECT_EQ(Vector3(frame.world_from_finger[1].col(1).head<3>()), Vector3(-Vector3::UnitZ()));
  }
}

/// The right gel is the left one turned by half a turn about z, and so is the box: with a mesh of any kind forces along
/// z are alike and those along x and y opposite.
TEST(Grasp, FingersAreAlikeUnderHalfATurn) {
  const std::vector<GraspPhase> motion{close_phase(3, kGrip_n), hold_phase(5)};
  const Grasp grasp = run_grasp(kBox, grasp_config(0.8), grasp_of(kMass_kg, motion));
  for (const GraspFrame& frame : grasp.frames) {
    const auto& [left, right] = frame.force_on_finger_n;
    EXPECT_LT((left - Vector3(-right.x(), -right.y(), right.z())).norm(), 1e-3 * kGrip_n);
  }
  EXPECT_GT(grasp.frames.back().force_on_finger_n[0].norm(), 0.9 * kGrip_n);
}

TEST(Grasp, DropsWhatIsTooHeavyAndFingersStayApart) {
  const std::vector<GraspPhase> motion{close_phase(3, kGrip_n), hold_phase(10), lift_phase(10, 5e-3), hold_phase(5)};
  const Grasp grasp = run_grasp(kBox, grasp_config(0.1), grasp_of(kMass_kg, motion));
  EXPECT_EQ(grasp.outcome, GraspOutcome::dropped);
  const GraspFrame& last = grasp.frames.back();
  EXPECT_LT(last.world_from_object(2, 3), -20e-3);
  EXPECT_LT(last.velocity_m_s.z(), -0.5);
  EXPECT_EQ(carried_n(last), 0.0);
  EXPECT_GT(fingers_apart_m(last), 6e-3);
  EXPECT_NEAR(hand_of(last).z(), 5e-3, 1e-12);
}

/// Once it is lost there is nothing that another `close` could close on: an outcome, not an error.
TEST(Grasp, ClosingOnWhatIsLostEndsAsDropped) {
  const std::vector<GraspPhase> motion{close_phase(3, kGrip_n), hold_phase(15), close_phase(2, 2.0), hold_phase(1)};
  const Grasp grasp = run_grasp(kBox, grasp_config(0.05), grasp_of(kMass_kg, motion));
  EXPECT_EQ(grasp.outcome, GraspOutcome::dropped);
  EXPECT_GT(fingers_apart_m(grasp.frames.back()), 6e-3);
  EXPECT_EQ(grasp.frames.size(), 22u);
}

/// What was lifted stays so when the fingers put it away.
TEST(Grasp, TheOutcomeIsThatBeforeTheRelease) {
  const std::vector<GraspPhase> motion{close_phase(3, kGrip_n), hold_phase(5), lift_phase(5, 2e-3),
                                       release_phase(5, 1e-3), hold_phase(3)};
  const Grasp grasp = run_grasp(kBox, grasp_config(0.8), grasp_of(kMass_kg, motion));
  EXPECT_EQ(grasp.outcome, GraspOutcome::lifted);
  EXPECT_EQ(grasp.judged_frame, 13u);
  EXPECT_EQ(grip_n(grasp.frames.back()), 0.0);
  EXPECT_LT(grasp.frames.back().velocity_m_s.z(), -0.1);
  // The fingers have opened by the way asked for, and stay there.
  EXPECT_NEAR(fingers_apart_m(grasp.frames[18]) - fingers_apart_m(grasp.frames[13]), 2e-3, 1e-9);
  EXPECT_EQ(fingers_apart_m(grasp.frames[21]), fingers_apart_m(grasp.frames[18]));
}

/// A second `close` grips harder, from the grip there is.
TEST(Grasp, ClosesAgainToAnotherForce) {
  const std::vector<GraspPhase> motion{close_phase(3, kGrip_n), hold_phase(3), close_phase(4, 2.0), hold_phase(3)};
  const Grasp grasp = run_grasp(kBox, grasp_config(0.8), grasp_of(kMass_kg, motion));
  EXPECT_NEAR(grip_n(grasp.frames[6]), 1.0, 0.05);
  EXPECT_NEAR(grip_n(grasp.frames[8]), 1.5, 0.1);
  EXPECT_NEAR(grip_n(grasp.frames[10]), 2.0, 0.04);
  EXPECT_NEAR(grip_n(grasp.frames[13]), 2.0, 0.04);
  EXPECT_EQ(grasp.outcome, GraspOutcome::lifted);
}

/// Half a turn in all, by each axis of the world: along the fingers, across them, and about the vertical. Whatever of
/// the weight lies along the fingers is the difference of their grips.
TEST(Grasp, TurnsTheObjectInTheHandWithIt) {
  const double weight = kMass_kg * kG, quarter = 0.5 * std::numbers::pi;
  for (const int axis : {0, 1, 2}) {
    const std::vector<GraspPhase> motion{close_phase(3, kGrip_n), hold_phase(8), turn_phase(20, quarter, axis),
                                         hold_phase(10)};
    const Grasp grasp = run_grasp(kBox, grasp_config(0.8), grasp_of(kMass_kg, motion));
    EXPECT_EQ(grasp.outcome, GraspOutcome::lifted) << axis;
    const Matrix3 turn = Eigen::AngleAxisd(quarter, Vector3::Unit(axis)).toRotationMatrix();
    const GraspFrame &before = grasp.frames[11], &after = grasp.frames.back();
    const auto rotation = [](const Matrix4& pose) -> Matrix3 { return pose.topLeftCorner<3, 3>(); };
    EXPECT_LT((rotation(after.world_from_hand) - turn).norm(), 1e-12) << axis;
    for (const std::size_t side : {0, 1}) {
      const Matrix4 expected = after.world_from_hand * before.world_from_finger[side];
      // Fingers close and open a little meanwhile, along their z.
      const Vector3 off = (after.world_from_finger[side] - expected).topRightCorner<3, 1>();
      EXPECT_LT((rotation(after.world_from_finger[side]) - rotation(expected)).norm(), 1e-12) << axis;
      EXPECT_LT(off.cross(Vector3(after.world_from_finger[side].col(2).head<3>())).norm(), 1e-12) << axis;
    }
    for (std::size_t f = 11; f < grasp.frames.size(); ++f) {
      const GraspFrame& frame = grasp.frames[f];
      EXPECT_LT(frame.slip_m, 0.1e-3) << axis << " " << f;
      EXPECT_LT(frame.turn_rad, 3e-3) << axis << " " << f;
      EXPECT_NEAR(carried_n(frame), weight, 0.02 * weight) << axis << " " << f;
      EXPECT_LT(grasp.fingers[0].frames[f].solver.body_residual_n, 1e-3 * weight) << axis << " " << f;
    }
    EXPECT_NEAR(carried_n(after), weight, 1e-3 * weight) << axis;
    // What was up lies along the closing axis now where the hand turned about y.
    const double along = after.grip_n(0) - after.grip_n(1);
    EXPECT_NEAR(std::abs(along), axis == 1 ? weight : 0.0, 2e-3 * weight) << axis;
  }
}

/// Damping of strain rates counts no turn: what it takes meanwhile is less than what the gels hold.
TEST(Grasp, ATurnStrainsNoGel) {
  PressConfig config = grasp_config(0.8);
  config.stiffness_damping_s = 0.02;
  const std::vector<GraspPhase> motion{close_phase(3, kGrip_n), hold_phase(8), turn_phase(10, 1.0, 1), hold_phase(4)};
  const Grasp grasp = run_grasp(kBox, config, grasp_of(kMass_kg, motion));
  const WholeAccount &before = grasp.frames[11].whole, &after = grasp.frames.back().whole;
  EXPECT_GT(before.damping_loss_j, 0.0);
  EXPECT_LT(after.damping_loss_j - before.damping_loss_j, before.elastic_j);
  EXPECT_NEAR(grip_n(grasp.frames.back()), kGrip_n, 0.02 * kGrip_n);
}

/// Momentum goes where forces say, and no energy is gained (but for 0.1 % of what is lost).
TEST(Grasp, AccountsForMomentumAndEnergyOfTheWhole) {
  const std::vector<GraspPhase> motion{close_phase(3, kGrip_n), hold_phase(5),          lift_phase(10, 3e-3),
                                       hold_phase(6),           turn_phase(10, 0.8, 1), hold_phase(6)};
  const Grasp grasp = run_grasp(kBox, grasp_config(0.8), grasp_of(kMass_kg, motion));
  const double weight = kMass_kg * kG;
  Vector3 lost = Vector3::Zero();
  double loss_j = 0.0;
  for (const GraspFrame& frame : grasp.frames) {
    const WholeAccount& whole = frame.whole;
    EXPECT_LT(whole.momentum_residual_n, 2e-3 * kGrip_n) << frame.time_s;
    // Friction on both sides of a gap of at most d̂ = 29 um; the origin is 20 mm away at most.
    EXPECT_LT(whole.angular_residual_n_m, 2 * 29e-6 * weight + 2e-3 * 0.02 * kGrip_n) << frame.time_s;
    lost = whole.momentum_kg_m_s - whole.impulse_n_s;
    EXPECT_LT(lost.norm(), 1e-4 * weight) << frame.time_s;
    EXPECT_GE(whole.method_loss_j, loss_j - 2e-8) << frame.time_s;
    EXPECT_GE(whole.friction_loss_j, 0.0);
    loss_j = whole.method_loss_j;
  }
  const WholeAccount &before = grasp.frames[8].whole, &raised = grasp.frames[24].whole;
  EXPECT_LT(grasp.frames[0].whole.elastic_j, 1e-15);  // zero but for rounding
  // Both gels weigh 2 x 0.8 g.
  const double gels_kg = (raised.gravitational_j - before.gravitational_j) / (kG * 3e-3) - kMass_kg;
  EXPECT_GT(gels_kg, 1e-3);
  EXPECT_LT(gels_kg, 3e-3);
  EXPECT_GT(raised.work_j - before.work_j, raised.gravitational_j - before.gravitational_j);
  EXPECT_LT(raised.work_j - before.work_j, 1.1 * (raised.gravitational_j - before.gravitational_j));
  EXPECT_LT(raised.kinetic_j, 1e-9);
  EXPECT_GT(before.elastic_j, 1e-6);
}

/// Straight paths of vertices would cut across a large turn.
TEST(Grasp, ATimeStepThatTurnsFarIsDivided) {
  const std::vector<GraspPhase> motion{close_phase(3, 2.0), hold_phase(3), turn_phase(2, 1.0, 0), hold_phase(5)};
  const Grasp grasp = run_grasp(kBox, grasp_config(0.8), grasp_of(kMass_kg, motion));
  // 0.5 rad each: in four parts of 0.125.
  for (const std::size_t f : {7, 8}) EXPECT_EQ(grasp.fingers[0].frames[f].solver.time_steps, 4) << f;
  EXPECT_EQ(grasp.fingers[0].frames[6].solver.time_steps, 1);
  EXPECT_EQ(grasp.outcome, GraspOutcome::lifted);
  EXPECT_LT(grasp.frames.back().turn_rad, 3e-3);
}

/// The object turns out of a grip that is too weak for its lever, and not out of a stronger one.
TEST(Grasp, ABarStaysBehindInAWeakGripThatTurns) {
  const auto turned = [](double force_n) {
    GraspSpec spec = grasp_of(0.03, {close_phase(3, force_n), hold_phase(3), turn_phase(10, 1.5, 0), hold_phase(5)});
    spec.grip_m = Vector3(0, 0, 0.011);  // it hangs from there
    return run_grasp(centered_box({4e-3, 4e-3, 15e-3}), grasp_config(0.5), spec);
  };
  EXPECT_EQ(turned(3.0).outcome, GraspOutcome::lifted);
  const Grasp weak = turned(0.8);
  EXPECT_NE(weak.outcome, GraspOutcome::lifted);
  EXPECT_GT(weak.frames.back().turn_rad, 0.1);
}

TEST(Grasp, ApproachesToAGapAndClosesToAWidth) {
  GraspSpec spec = grasp_of(kMass_kg, {approach_phase(2, 0.2e-3), close_to_phase(4, 7.7e-3), hold_phase(5),
                                       lift_phase(5, 2e-3), close_phase(3, 0.5), release_phase(2, 1e-3)});
  spec.start_gap_m = 1e-3;
  spec.closing_speed_m_s = 0.05;
  const Grasp grasp = run_grasp(kBox, grasp_config(0.8), spec);
  EXPECT_NEAR(fingers_apart_m(grasp.frames[0]), 10e-3, 1e-12);
  // 0.5 mm per time step at most, 0.8 mm in all.
  EXPECT_NEAR(fingers_apart_m(grasp.frames[1]), 9e-3, 1e-9);
  EXPECT_NEAR(fingers_apart_m(grasp.frames[2]), 8.4e-3, 1e-9);
  EXPECT_EQ(grasp.frames[2].phase, PhaseKind::approach);
  EXPECT_EQ(grasp.frames[2].world_from_object, grasp.frames[0].world_from_object);
  EXPECT_EQ(grasp.frames[2].grip_n(0), 0.0);
  EXPECT_NEAR(fingers_apart_m(grasp.frames[4]), 8.05e-3, 1e-9);
  EXPECT_EQ(grasp.freed_frame, 6u);
  for (std::size_t f = 6; f <= 16; ++f) EXPECT_NEAR(fingers_apart_m(grasp.frames[f]), 7.7e-3, 1e-9) << f;
  EXPECT_GT(grip_n(grasp.frames[6]), 0.6);
  // The width stays as the gels settle, and a force may follow, from the grip there is.
  EXPECT_GT(grip_n(grasp.frames[17]), 0.5);
  EXPECT_NEAR(grip_n(grasp.frames[19]), 0.5, 0.01);
  EXPECT_GT(fingers_apart_m(grasp.frames[19]), 7.7e-3);
  EXPECT_NEAR(fingers_apart_m(grasp.frames[21]) - fingers_apart_m(grasp.frames[19]), 2e-3, 1e-9);
  EXPECT_EQ(grasp.outcome, GraspOutcome::lifted);
}

/// Fingers that close to a width beyond the object's have not dropped it: they never had it.
TEST(Grasp, WhatNoFingerTouchesIsUntouched) {
  for (const double width_m : {10e-3, 12e-3, 8.5e-3}) {
    GraspSpec spec = grasp_of(kMass_kg, {close_to_phase(2, width_m), hold_phase(2), lift_phase(4, 2e-3)});
    spec.start_gap_m = 2.5e-3;
    spec.closing_speed_m_s = 0.1;
    const Grasp grasp = run_grasp(kBox, grasp_config(0.8), spec);
    EXPECT_EQ(grasp.outcome, GraspOutcome::untouched) << width_m;
    EXPECT_EQ(grasp.reason, GraspReason::no_contact) << width_m;
    EXPECT_FALSE(touches(grasp.fingers[0].frames.back())) << width_m;
  }
}

TEST(Grasp, SaysThatFingersAreTooSlowForTheirWay) {
  GraspSpec spec = grasp_of(kMass_kg, {approach_phase(1, 0.1e-3), close_phase(1, kGrip_n)});
  spec.start_gap_m = 1e-3;
  spec.closing_speed_m_s = 1e-5;
  EXPECT_THAT(message_of<SolverError>([&] { run_grasp(kBox, grasp_config(0.8), spec); }),
              HasSubstr("give the phase more steps, or the fingers a larger closing_speed_mm_s"));
}

/// A bar gripped off its centre: m g ℓ against what both pads can bear, μ N r each with r the mean distance of their
/// pressure from the grip axis. Of a square of half side b it is 0.765 b where the pressure is even.
TEST(Grasp, ABarTurnsAboutTheGripAxisWhereFrictionIsTooSmallForItsLever) {
  constexpr double kBarMass_kg = 0.03, kMu = 0.5, kHalfWidth_m = 4e-3;
  const double bears_n_m = 2.0 * kMu * kGrip_n * 0.765 * kHalfWidth_m;
  const auto turned = [&](double lever_m) {
    GraspSpec spec = grasp_of(kBarMass_kg, {close_phase(3, kGrip_n), hold_phase(10), lift_phase(5, 1e-3)});
    spec.grip_m = Vector3(0, lever_m, 0);
    return run_grasp(kBar, grasp_config(kMu), spec);
  };
  const double held = 0.8e-2, turns = 2e-2;
  ASSERT_LT(kBarMass_kg * kG * held, 0.8 * bears_n_m);
  ASSERT_GT(kBarMass_kg * kG * turns, 1.2 * bears_n_m);
  const Grasp steady = turned(held), turning = turned(turns);
  EXPECT_EQ(steady.outcome, GraspOutcome::lifted);
  EXPECT_LT(steady.frames.back().turn_rad, 0.02);
  EXPECT_EQ(turning.outcome, GraspOutcome::rotated);
  EXPECT_GT(turning.frames.back().turn_rad, 5.0 * std::numbers::pi / 180.0);
  // About x, the centre of mass going down: it lies at −ℓ along y of the grip.
  const Matrix4& end = turning.frames.back().world_from_object;
  EXPECT_GT(std::abs(end(1, 2)), 10.0 * std::abs(end(0, 1)));
  EXPECT_LT((end * turning.center_of_mass_m.homogeneous()).z(), -1e-3);
}

/// Where the object's file has its origin tells nothing: far off, the origin goes down as the bar turns in the hand.
TEST(Grasp, TheOutcomeDoesNotDependOnTheObjectsOrigin) {
  GraspSpec spec = grasp_of(0.03, {close_phase(3, kGrip_n), hold_phase(10), lift_phase(5, 1e-3)});
  spec.grip_m = Vector3(0, 0.02, 0);
  TriangleMesh far = kBar;
  far.positions.col(1).array() += 0.1;
  const Grasp near_by = run_grasp(kBar, grasp_config(0.5), spec), far_off = run_grasp(far, grasp_config(0.5), spec);
  EXPECT_EQ(near_by.outcome, GraspOutcome::rotated);
  EXPECT_EQ(far_off.outcome, GraspOutcome::rotated);
  EXPECT_NEAR(far_off.frames.back().slip_m, near_by.frames.back().slip_m, 0.1 * near_by.frames.back().slip_m);
  EXPECT_LT((far_off.center_of_mass_m - Vector3(0, 0.1, 0)).norm(), 1e-12);
}

const std::vector<GraspPhase> kManyPhases{
    {.kind = PhaseKind::close, .steps = 3, .substeps = 3, .force_n = 0.7},
    hold_phase(1),
    {.kind = PhaseKind::close, .steps = 3, .substeps = 3, .force_n = 1.1},
    lift_phase(2, 1e-3),
    {.kind = PhaseKind::shake, .steps = 2, .amplitude_m = 1e-4, .frequency_hz = 25.0, .axis = 1},
    turn_phase(2, 0.3, 1),
    close_to_phase(2, 7.9e-3),
    release_phase(2, 5e-4),
    hold_phase(1)};

TEST(Grasp, GoesOnFromAnyFrameToTheSameBytes) {
  MemoryStore whole;
  const Grasp grasp = run_grasp(kBox, grasp_config(0.8), grasp_of(kMass_kg, kManyPhases), &whole);
  ASSERT_EQ(whole.saved.size(), 19u);
  for (const std::size_t known : {1, 2, 3, 4, 5, 6, 8, 10, 12, 13, 14, 15, 16, 18, 19}) {
    MemoryStore rest({whole.saved.begin(), whole.saved.begin() + static_cast<std::ptrdiff_t>(known)});
    const Grasp again = run_grasp(kBox, grasp_config(0.8), grasp_of(kMass_kg, kManyPhases), &rest);
    EXPECT_TRUE(rest.saved == whole.saved) << "from " << known << " frames";
    EXPECT_EQ(again.outcome, grasp.outcome);
    EXPECT_EQ(again.judged_frame, grasp.judged_frame);
    EXPECT_EQ(again.grip_n, grasp.grip_n);
    EXPECT_EQ(again.frames.back().slip_m, grasp.frames.back().slip_m);
    EXPECT_EQ(again.frames.back().whole.work_j, grasp.frames.back().whole.work_j);
  }
}

TEST(Grasp, DamagedFramesAreRefused) {
  MemoryStore whole;
  const GraspSpec spec = grasp_of(kMass_kg, {close_phase(1, kGrip_n)});
  run_grasp(kBox, grasp_config(0.8), spec, &whole);
  const std::string& first = whole.saved[0];
  for (const std::size_t size : {std::size_t{0}, std::size_t{100}, first.size() - 1}) {
    MemoryStore cut({first.substr(0, size)});
    EXPECT_THROW(run_grasp(kBox, grasp_config(0.8), spec, &cut), DataError) << size;
  }
  MemoryStore more({first + "x"});
  EXPECT_THROW(run_grasp(kBox, grasp_config(0.8), spec, &more), DataError);
}

TEST(Grasp, AnyNumberOfThreadsGivesTheSameBytes) {
  const auto with = [](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    MemoryStore store;
    run_grasp(kBox, grasp_config(0.8), grasp_of(kMass_kg, {close_phase(3, kGrip_n), hold_phase(3)}), &store);
    return store.saved;
  };
  EXPECT_TRUE(with(1) == with(3));
}

/// With one iteration less than the longest time step takes, that does not converge and is divided.
TEST(Grasp, ADividedTimeStepGivesAResult) {
  const std::vector<GraspPhase> motion{close_phase(3, kGrip_n), hold_phase(10), lift_phase(2, 3e-3), hold_phase(15)};
  PressConfig config = grasp_config(0.8);
  const Grasp whole = run_grasp(kBox, config, grasp_of(kMass_kg, motion));
  const std::vector<Frame>& frames = whole.fingers[0].frames;
  const auto fewer = [](const Frame& a, const Frame& b) {
    return a.solver.newton_iterations < b.solver.newton_iterations;
  };
  // After the fingers have closed: the last frame of that has several time steps.
  config.newton.max_iterations =
      std::max_element(frames.begin() + 4, frames.end(), fewer)->solver.newton_iterations - 1;
  config.max_halvings = 6;
  const Grasp grasp = run_grasp(kBox, config, grasp_of(kMass_kg, motion));
  bool divided = false;
  for (std::size_t f = 0; f < frames.size(); ++f)
    divided = divided || grasp.fingers[0].frames[f].solver.time_steps > frames[f].solver.time_steps;
  EXPECT_TRUE(divided);
  EXPECT_EQ(grasp.outcome, GraspOutcome::lifted);
  const GraspFrame& last = grasp.frames.back();
  EXPECT_NEAR(carried_n(last), kMass_kg * kG, 2e-3 * kMass_kg * kG);
  EXPECT_NEAR(grip_n(last), kGrip_n, 0.02 * kGrip_n);
  EXPECT_NEAR(hand_of(last).z(), 3e-3, 1e-12);
}

std::string refusal(const TriangleMesh& object, const PressConfig& config, const GraspSpec& spec) {
  return message_of<std::exception>([&] { run_grasp(object, config, spec); });
}

TEST(Grasp, RefusesWhatItCannotDo) {
  const GraspSpec spec = grasp_of(kMass_kg, {close_phase(1, kGrip_n)});
  const PressConfig usual = grasp_config(0.8);
  PressConfig config = usual;
  config.augmented_lagrangian = true;
  EXPECT_THAT(refusal(kBox, config, spec), HasSubstr("a grasp needs elimination"));
  EXPECT_THROW(run_grasp(kBox, config, spec), UsageError);
  config = usual;
  config.mass_damping_per_s = 1.0;
  EXPECT_THAT(refusal(kBox, config, spec), HasSubstr("damping.mass_per_s would hold back fingers that move"));
  config = usual;
  config.gravity_m_s2 = Vector3(0, 0, -kG);
  EXPECT_THAT(refusal(kBox, config, spec), HasSubstr("fingers.gravity_m_s2"));
  TriangleMesh open = kBox;
  open.triangles.conservativeResize(open.triangles.rows() - 1, 3);
  EXPECT_THAT(refusal(open, usual, spec), HasSubstr("the object is not closed"));
  config = usual;
  config.pair_counting.once = false;
  EXPECT_THAT(refusal(open, config, spec), HasSubstr("the object is not closed"));
  GraspSpec beside = spec;
  beside.grip_m = Vector3(0, 0.05, 0);
  EXPECT_THAT(refusal(kBox, usual, beside), HasSubstr("nothing of the object between the fingers"));
}

TEST(Grasp, WarnsOfUnevenFingersAndOfNoFriction) {
  const auto said = [](const TriangleMesh& object, double mu) {
    PressConfig config = grasp_config(0.8);
    config.friction->coefficient = mu;
    if (mu == 0.0) config.friction.reset();
    open_log("press", "warning");
    testing::internal::CaptureStderr();
    run_grasp(object, config, grasp_of(kMass_kg, {close_phase(2, 0.3)}));
    close_log();
    return testing::internal::GetCapturedStderr();
  };
  EXPECT_EQ(said(kBox, 0.8), "");
  EXPECT_THAT(said(kBox, 0.0), HasSubstr("the press file has no friction"));
  // A pyramid's tip on the left, its base on the right.
  TriangleMesh tip = pyramid(3e-3, 3e-3);
  tip.positions = Positions(tip.positions(Eigen::all, std::vector<int>{2, 0, 1}));
  EXPECT_THAT(said(tip, 0.8), HasSubstr("the left finger pressed with"));
}

}  // namespace grasp_test
}  // namespace tacipc
