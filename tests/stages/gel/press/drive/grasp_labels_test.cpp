#include "stages/gel/press/drive/grasp_labels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/stages/gel/press/drive/grasp_scene.h"

namespace tacipc {
namespace grasp_labels_test {

constexpr double kMu = 0.3, kGrip_n = 1.0, kMost_n = 2.0 * kMu * kGrip_n;

/// A plate whose faces are larger than the gels, closed on in even steps.
Grasp plate_of(double weight_n, std::vector<GraspPhase> then, double lever_m = 0.0) {
  then.insert(then.begin(), close_phase(8, kGrip_n));
  GraspSpec spec = grasp_of(weight_n / kG, std::move(then));
  spec.grip_m = Vector3(0, lever_m, 0);
  return run_grasp(centered_box({4e-3, 30e-3, 14e-3}), grasp_config(kMu), spec);
}

GraspPhase shake_phase(int steps, double amplitude_m, double frequency_hz) {
  return {.kind = PhaseKind::shake, .steps = steps, .amplitude_m = amplitude_m, .frequency_hz = frequency_hz};
}

TEST(FingerContact, SharesAndRadiusAreOfTheNormalForce) {
  const TetMesh gel = block_gel(4, 0.02, 0.002);
  const FrontSurface front = make_front_surface(gel);
  const auto n = static_cast<Eigen::Index>(front.vertices.size());
  Frame frame;
  frame.positions = gel.positions;
  frame.normal_force_n = Positions::Zero(n, 3);
  frame.contact_state.assign(front.vertices.size(), ContactState::none);
  EXPECT_EQ(finger_contact(front, frame).slip_share, 0.0);
  EXPECT_EQ(finger_contact(front, frame).friction_radius_m, 0.0);
  // 3 N that stick and 1 N that slips, whose lengths count whatever their directions.
  frame.normal_force_n.row(0) << 0.0, 0.0, -3.0;
  frame.normal_force_n.row(n - 1) << 0.6, 0.0, -0.8;
  frame.contact_state[0] = ContactState::stick;
  frame.contact_state.back() = ContactState::slip;
  const double apart_m =
      (gel.positions.row(front.vertices.front()) - gel.positions.row(front.vertices.back())).head<2>().norm();
  ASSERT_GT(apart_m, 0.01);
  const FingerContact contact = finger_contact(front, frame);
  EXPECT_NEAR(contact.slip_share, 0.25, 1e-12);
  // A quarter of the way from the larger force is the centre: (3 × 1/4 + 1 × 3/4) / 4.
  EXPECT_NEAR(contact.friction_radius_m, 0.375 * apart_m, 1e-12);
}

TEST(GraspLabels, WhatIsHeldNeverSlipsAsAWholeAndHasNoReason) {
  const Grasp grasp = plate_of(0.5 * kMost_n, {hold_phase(5), lift_phase(10, 2e-3), hold_phase(5)});
  EXPECT_EQ(grasp.outcome, GraspOutcome::lifted);
  EXPECT_FALSE(grasp.reason);
  for (const SlipTimes& times : grasp.slips) EXPECT_FALSE(times.gross_s);
  ASSERT_EQ(grasp.contacts.size(), grasp.frames.size());
  ASSERT_EQ(grasp.friction_use.size(), grasp.frames.size() - grasp.freed_frame);
  // At rest friction bears half of what it can; while it speeds up, m (g + a).
  EXPECT_NEAR(grasp.friction_use.back(), 0.5, 0.02);
  const double most = *std::max_element(grasp.friction_use.begin(), grasp.friction_use.end());
  EXPECT_NEAR(most, 0.5 * (1.0 + 6.0 * 2e-3 / (0.1 * 0.1) / kG), 0.03);
}

/// Two parts in a hundred below what friction can carry: creep is no gross slip, however long it lasts.
TEST(GraspLabels, CreepIsNoGrossSlip) {
  const Grasp grasp = plate_of(0.98 * kMost_n, {hold_phase(40)});
  EXPECT_EQ(grasp.outcome, GraspOutcome::lifted);
  EXPECT_FALSE(grasp.reason);
  EXPECT_GT(grasp.frames.back().slip_m, 10e-6);
  // Where it is let go all of it slips for a moment, by micrometres.
  double most = 0.0;
  for (std::size_t f = grasp.freed_frame + 1; f < grasp.frames.size(); ++f)
    most = std::max(most, grasp.contacts[f][0].slip_share);
  EXPECT_GE(most, kGrossSlipShare);
  for (const SlipTimes& times : grasp.slips) EXPECT_FALSE(times.gross_s);
}

/// Friction that sticks up to 20 mm/s creeps by millimetres in a second. Inside the cone that is no slip, and is told
/// apart: three loads, and one outside of the cone.
TEST(GraspLabels, CreepIsNotSlippedHoweverFarItGoes) {
  const auto held = [](double use, double lever_m) {
    GraspSpec spec = grasp_of(use * kMost_n / kG, {close_phase(8, kGrip_n), hold_phase(40)});
    spec.grip_m = Vector3(0, lever_m, 0);
    PressConfig config = grasp_config(kMu);
    config.friction->relative_speed_threshold = 0.7;  // of 28.4 mm
    return run_grasp(centered_box({4e-3, 30e-3, 30e-3}), config, spec);
  };
  for (const double use : {0.6, 0.75, 0.9}) {
    const Grasp grasp = held(use, 0.0);
    const GraspFrame& last = grasp.frames[grasp.judged_frame];
    EXPECT_GT(last.slip_m, kSlipped_m) << use;
    EXPECT_LT(last.slid_m, 0.3 * last.slip_m) << use;
    EXPECT_NEAR(last.creep_m, last.slip_m, 0.3 * last.slip_m) << use;
    EXPECT_EQ(grasp.outcome, GraspOutcome::lifted) << use;
    EXPECT_FALSE(grasp.reason) << use;
  }
  const Grasp lost = held(1.4, 0.0);
  EXPECT_NE(lost.outcome, GraspOutcome::lifted);
  EXPECT_EQ(lost.reason, GraspReason::weight);
  EXPECT_LT(lost.frames[lost.judged_frame].creep_m, 0.5 * lost.frames[lost.judged_frame].slip_m);
}

TEST(GraspLabels, WhatIsTooHeavySlipsAtOnceForItsWeight) {
  const Grasp grasp = plate_of(1.3 * kMost_n, {hold_phase(20)});
  EXPECT_NE(grasp.outcome, GraspOutcome::lifted);
  EXPECT_EQ(grasp.reason, GraspReason::weight);
  const double freed_s = grasp.frames[grasp.freed_frame].time_s;
  for (const SlipTimes& times : grasp.slips) {
    ASSERT_TRUE(times.first_s && times.gross_s);
    EXPECT_GT(*times.first_s, freed_s);
    EXPECT_LE(*times.first_s, *times.gross_s);
    EXPECT_LT(*times.gross_s, freed_s + 0.06);
  }
}

TEST(GraspLabels, WhatOnlyAShakeLosesFailsByAcceleration) {
  // At most 7.1 m/s².
  const Grasp grasp = plate_of(0.8 * kMost_n, {hold_phase(5), shake_phase(10, 4e-3, 2.0 * 4.75)});
  EXPECT_NE(grasp.outcome, GraspOutcome::lifted);
  EXPECT_EQ(grasp.reason, GraspReason::acceleration);
  const double shaken_s = grasp.frames[grasp.freed_frame + 5].time_s;
  for (const SlipTimes& times : grasp.slips) {
    ASSERT_TRUE(times.gross_s);
    EXPECT_GT(*times.gross_s, shaken_s);
  }
}

TEST(GraspLabels, WhatItsLeverTurnsFailsByTorque) {
  const Grasp grasp = plate_of(0.8 * kMost_n, {hold_phase(30)}, 18e-3);
  EXPECT_NE(grasp.outcome, GraspOutcome::lifted);
  EXPECT_EQ(grasp.reason, GraspReason::torque);
}

/// The same by a centre of mass that lies beside that of the solid, gripped in its middle.
TEST(GraspLabels, AShiftedCenterOfMassIsALever) {
  GraspSpec spec = grasp_of(0.8 * kMost_n / kG, {close_phase(8, kGrip_n), hold_phase(30)});
  spec.center_shift_m = Vector3(0, -18e-3, 0);
  const Grasp shifted = run_grasp(centered_box({4e-3, 30e-3, 14e-3}), grasp_config(kMu), spec);
  EXPECT_EQ(shifted.reason, GraspReason::torque);
  EXPECT_NEAR(shifted.pose.lever_m(), 18e-3, 1e-12);
  EXPECT_LT((shifted.grip_point()).norm(), 1e-12);
  EXPECT_LT((shifted.center_of_mass_m - spec.center_shift_m).norm(), 1e-12);
}

/// A friction of the object's own takes the place of the press file's, in everything.
TEST(GraspLabels, TheObjectMayHaveAFrictionOfItsOwn) {
  GraspSpec spec = grasp_of(0.8 * kMost_n / kG, {close_phase(8, kGrip_n), hold_phase(10)});
  const TriangleMesh plate = centered_box({4e-3, 30e-3, 14e-3});
  const Grasp by_file = run_grasp(plate, grasp_config(kMu), spec);
  spec.friction_coefficient = kMu;
  const Grasp by_object = run_grasp(plate, grasp_config(0.9), spec);
  EXPECT_EQ(by_object.friction, kMu);
  EXPECT_EQ(by_object.frames.back().world_from_object, by_file.frames.back().world_from_object);
  EXPECT_EQ(by_object.friction_use, by_file.friction_use);
}

/// What friction could bear, but was pushed aside when it was let go.
TEST(GraspLabels, UnevenGripsAreAReasonWhereFrictionWasEnough) {
  Grasp grasp = plate_of(0.5 * kMost_n, {hold_phase(3)});
  ASSERT_EQ(grasp.outcome, GraspOutcome::lifted);
  const auto judged_as_slipped = [&] {
    grasp.outcome = GraspOutcome::slipped;
    grasp.friction_use.clear();
    add_labels(grasp);
    return grasp.reason;
  };
  EXPECT_EQ(judged_as_slipped(), GraspReason::other);
  grasp.frames[grasp.freed_frame].force_on_finger_n[0] *= 1.3;
  EXPECT_EQ(judged_as_slipped(), GraspReason::uneven_grip);
}

TEST(GraspLabels, AFingerThatDoesNotTouchWhenItIsFreedIsTheReason) {
  Grasp grasp = plate_of(1.3 * kMost_n, {hold_phase(10)});
  ASSERT_EQ(grasp.reason, GraspReason::weight);
  grasp.frames[grasp.freed_frame].force_on_finger_n[1].setZero();
  grasp.friction_use.clear();
  add_labels(grasp);
  EXPECT_EQ(grasp.reason, GraspReason::no_contact);
}

}  // namespace grasp_labels_test
}  // namespace tacipc
