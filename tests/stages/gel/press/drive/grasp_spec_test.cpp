#include "stages/gel/press/drive/grasp_spec.h"

#include <fmt/core.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "common/base/error.h"
#include "tests/config_text.h"
#include "tests/stages/gel/press/drive/grasp_scene.h"

namespace tacipc {
namespace grasp_spec_test {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::UnorderedElementsAre;

std::string text_of(const std::string& fingers, const std::string& object, const std::string& motion) {
  return "fingers: {" + fingers + "}\nobject: {" + object + "}\nmotion:\n" + motion;
}

const std::string kClose = "  - {kind: close, steps: 4, force_n: 2}\n";

GraspSpec read(const std::string& fingers, const std::string& object, const std::string& motion = kClose) {
  return config_from_text<GraspSpec>(text_of(fingers, object, motion), "grasp.yaml");
}

std::vector<std::string> faults(const std::string& fingers, const std::string& object,
                                const std::string& motion = kClose) {
  return faults_in<GraspSpec>(text_of(fingers, object, motion), "grasp.yaml");
}

TEST(GraspSpec, EveryValueIsInSi) {
  const GraspSpec spec =
      read("turn_deg: 90, grip_mm: [1, 2, 3], gravity_m_s2: [0, 0, -1.6], closing_speed_mm_s: 5", "mass_g: 50",
           kClose +
               "  - {kind: lift, steps: 5, substeps: 2, distance_mm: 10}\n"
               "  - {kind: hold, steps: 6}\n"
               "  - {kind: shake, steps: 7, amplitude_mm: 4, frequency_hz: 3, axis: y}\n"
               "  - {kind: shake, steps: 7, amplitude_mm: 4, frequency_hz: 3}\n"
               "  - {kind: release, steps: 8, distance_mm: 2}\n");
  EXPECT_EQ(spec.turn_rad, 0.5 * std::numbers::pi);
  EXPECT_LT((spec.grip_m - Vector3(1e-3, 2e-3, 3e-3)).norm(), 1e-18);
  EXPECT_EQ(spec.gravity_m_s2, Vector3(0, 0, -1.6));
  EXPECT_DOUBLE_EQ(spec.closing_speed_m_s, 5e-3);
  EXPECT_DOUBLE_EQ(spec.mass_kg.value(), 0.05);
  ASSERT_EQ(spec.motion.size(), 6u);
  EXPECT_EQ(spec.motion[0].kind, PhaseKind::close);
  EXPECT_EQ(spec.motion[0].force_n, 2.0);
  EXPECT_EQ(spec.motion[0].steps, 4);
  EXPECT_EQ(spec.motion[0].substeps, 1);
  EXPECT_EQ(spec.motion[1].kind, PhaseKind::lift);
  EXPECT_DOUBLE_EQ(spec.motion[1].distance_m, 0.01);
  EXPECT_EQ(spec.motion[1].substeps, 2);
  EXPECT_EQ(spec.motion[2].kind, PhaseKind::hold);
  EXPECT_EQ(spec.motion[3].kind, PhaseKind::shake);
  EXPECT_DOUBLE_EQ(spec.motion[3].amplitude_m, 4e-3);
  EXPECT_EQ(spec.motion[3].frequency_hz, 3.0);
  EXPECT_EQ(spec.motion[3].axis, 1);
  EXPECT_EQ(spec.motion[4].axis, 2);
  EXPECT_EQ(spec.motion[5].kind, PhaseKind::release);
  EXPECT_DOUBLE_EQ(spec.motion[5].distance_m, 2e-3);
  EXPECT_FALSE(spec.motion[0].width_m);
}

TEST(GraspSpec, FingersMayApproachCloseToAWidthAndTurn) {
  const GraspSpec spec = read("start_gap_mm: 3", "mass_g: 50",
                              "  - {kind: approach, steps: 5, gap_mm: 0.5}\n"
                              "  - {kind: close, steps: 6, width_mm: 12}\n"
                              "  - {kind: turn, steps: 7, turn_deg: -90, axis: x}\n");
  EXPECT_DOUBLE_EQ(spec.start_gap_m.value(), 3e-3);
  ASSERT_EQ(spec.motion.size(), 3u);
  EXPECT_EQ(spec.motion[0].kind, PhaseKind::approach);
  EXPECT_DOUBLE_EQ(spec.motion[0].gap_m, 0.5e-3);
  EXPECT_DOUBLE_EQ(spec.motion[1].width_m.value(), 0.012);
  EXPECT_EQ(spec.motion[2].kind, PhaseKind::turn);
  EXPECT_EQ(spec.motion[2].angle_rad, -0.5 * std::numbers::pi);
  EXPECT_EQ(spec.motion[2].axis, 0);
}

TEST(GraspSpec, WhatIsNotSaidIsAnUprightObjectGrippedAtItsCenterOnEarth) {
  const GraspSpec spec = read("", "density_kg_m3: 1200");
  EXPECT_FALSE(spec.mass_kg);
  EXPECT_FALSE(spec.start_gap_m);
  EXPECT_EQ(spec.density_kg_m3, 1200.0);
  EXPECT_EQ(spec.turn_rad, 0.0);
  EXPECT_EQ(spec.grip_m, Vector3::Zero());
  EXPECT_EQ(spec.gravity_m_s2, Vector3(0, 0, -9.81));
  EXPECT_DOUBLE_EQ(spec.closing_speed_m_s, 0.02);
}

TEST(GraspSpec, DrivesHaveMassAndDampingAndMayBeOneOrTwo) {
  const GraspSpec usual = read("", "mass_g: 50");
  EXPECT_TRUE(usual.mount.none());
  EXPECT_FALSE(usual.drive_each);
  EXPECT_FALSE(read("drive: one, mount: {}", "mass_g: 50").drive_each);
  const GraspSpec spec = read("drive: each, mount: {mass_g: 200, damping_n_s_m: 30}", "mass_g: 50");
  EXPECT_TRUE(spec.drive_each);
  EXPECT_DOUBLE_EQ(spec.mount.mass_kg, 0.2);
  EXPECT_EQ(spec.mount.damping_n_s_m, 30.0);
  EXPECT_DOUBLE_EQ(spec.mount.stiffness_n_m(0.01), 5000.0);
  EXPECT_THAT(faults("drive: both, mount: {mass_g: -1, damping_n_s_m: -2, mass_kg: 3}", "mass_g: 50"),
              UnorderedElementsAre(HasSubstr("fingers.drive"), HasSubstr("fingers.mount.mass_g"),
                                   HasSubstr("fingers.mount.damping_n_s_m"), HasSubstr("fingers.mount.mass_kg")));
}

TEST(GraspSpec, FingersCloseFirst) {
  EXPECT_THAT(faults("", "mass_g: 50", "  - {kind: lift, steps: 5, distance_mm: 10}\n" + kClose),
              ElementsAre(HasSubstr("motion[0].kind: fingers close first: nothing is held before")));
  EXPECT_THAT(faults("", "mass_g: 50", kClose + "  - {kind: approach, steps: 5, gap_mm: 1}\n"),
              ElementsAre(HasSubstr("motion[1].kind: fingers approach before they first close")));
  EXPECT_THAT(faults("", "mass_g: 50", "  - {kind: approach, steps: 5, gap_mm: 1}\n"),
              ElementsAre(HasSubstr("motion: fingers never close")));
}

TEST(GraspSpec, RefusesWhatAPhaseDoesNotHave) {
  EXPECT_THAT(faults("", "mass_g: 50", kClose + "  - {kind: hold, steps: 5, distance_mm: 10}\n"),
              ElementsAre(HasSubstr("motion[1].distance_mm: unknown")));
  EXPECT_THAT(faults("", "mass_g: 50", "  - {kind: close, steps: 5}\n"), ElementsAre(HasSubstr("force_n: missing")));
  EXPECT_THAT(faults("", "mass_g: 50", "  - {kind: close, steps: 5, force_n: 0}\n"),
              ElementsAre(HasSubstr("motion[0].force_n: 0 is outside")));
  EXPECT_THAT(faults("", "mass_g: 50", kClose + "  - {kind: press, steps: 5}\n"),
              Contains(HasSubstr("'press' is not one of approach, close, lift, hold, shake, turn, release")));
  EXPECT_THAT(
      faults("", "mass_g: 50", kClose + "  - {kind: shake, steps: 5, amplitude_mm: 1, frequency_hz: 2, axis: x}\n"),
      ElementsAre(HasSubstr("'x' is not one of y, z")));
  EXPECT_THAT(faults("", "mass_g: 50", "  - {kind: close, steps: 5, force_n: 1, width_mm: 3}\n"),
              ElementsAre(HasSubstr("motion[0].force_n: give force_n or width_mm, not both")));
  EXPECT_THAT(faults("", "mass_g: 50", kClose + "  - {kind: turn, steps: 5, turn_deg: 3}\n"),
              ElementsAre(HasSubstr("motion[1].axis: missing")));
}

TEST(GraspSpec, TheObjectHasAMassOrADensity) {
  EXPECT_THAT(faults("", "mass_g: 50, density_kg_m3: 1200"),
              ElementsAre(HasSubstr("give mass_g or density_kg_m3, not both")));
  EXPECT_THAT(faults("", ""), ElementsAre(HasSubstr("object.density_kg_m3: missing")));
  EXPECT_THAT(faults("", "mass_g: -1"), ElementsAre(HasSubstr("object.mass_g: -1 is outside")));
}

TEST(GraspSpec, AnObjectIsRotatedAndThenTurned) {
  const double half = std::sqrt(0.5);
  const GraspSpec spec = read(fmt::format("rotation_xyzw: [{}, 0, 0, {}], turn_deg: 90", half, half), "mass_g: 50");
  const GraspPose pose = spec.pose_of({}, {}, {}, 0.5);
  // y goes to z; z to -y, and from there to x.
  EXPECT_LT((pose.world_from_object * Vector3::UnitY() - Vector3::UnitZ()).norm(), 1e-12);
  EXPECT_LT((pose.world_from_object * Vector3::UnitZ() - Vector3::UnitX()).norm(), 1e-12);
  EXPECT_FALSE(pose.width_m);
  EXPECT_THAT(faults("rotation_xyzw: [0, 0, 0, 2]", "mass_g: 50"),
              ElementsAre(HasSubstr("fingers.rotation_xyzw: is no unit quaternion")));
}

TEST(GraspSpec, AGraspIsDrawnOrGiven) {
  const TriangleMesh box = centered_box(Vector3(0.01, 0.015, 0.02));
  const GraspSpec spec = read("draw: {seed: 3, patch_mm: 2}", "mass_g: 50");
  const GelShape front{.outline = GelShape::Outline::disc, .radius_m = 0.01, .thickness_m = 0.002};
  const GraspPose pose = spec.pose_of(box, mass_properties(box.positions, box.triangles), front, 0.5);
  const GraspPose same = draw_grasp(box, Vector3::Zero(), front, 0.5, {.seed = 3, .patch_m = 2e-3});
  EXPECT_LT((pose.grip_m - same.grip_m).norm(), 1e-12);
  EXPECT_LT((pose.world_from_object - same.world_from_object).norm(), 1e-12);
  EXPECT_THAT(faults("draw: {}, turn_deg: 30, grip_mm: [0, 0, 1]", "mass_g: 50"),
              UnorderedElementsAre(HasSubstr("fingers.turn_deg: is drawn"), HasSubstr("fingers.grip_mm: is drawn")));
}

TEST(GraspSpec, AMarginIsAMass) {
  const GraspSpec spec = read("gravity_m_s2: [0, 0, -10]", "friction_margin: 2");
  EXPECT_NEAR(spec.density_of(1e-5, 0.5) * 1e-5, 0.1, 1e-12);  // 2 × 0.5 × 2 N carry twice the weight of 100 g
  EXPECT_THROW(spec.density_of(1e-5, 0.0), UsageError);
  EXPECT_THAT(faults("", "friction_margin: 2, density_kg_m3: 1000"),
              ElementsAre(HasSubstr("give friction_margin or density_kg_m3, not both")));
  EXPECT_THAT(faults("gravity_m_s2: [0, 0, 0]", "friction_margin: 2"),
              ElementsAre(HasSubstr("nothing has weight without gravity_m_s2")));
}

TEST(GraspSpec, AnObjectsFrictionTakesThePlaceOfThePressFiles) {
  const GraspSpec spec = read("", "mass_g: 50, friction: 0.3");
  PressConfig config = grasp_config(0.9);
  EXPECT_EQ(spec.pressed_with(config).friction->coefficient, 0.3);
  EXPECT_EQ(spec.pressed_with(config).friction->relative_speed_threshold, config.friction->relative_speed_threshold);
  EXPECT_EQ(read("", "mass_g: 50").pressed_with(config).friction->coefficient, 0.9);
  config.friction.reset();
  EXPECT_THROW(spec.pressed_with(config), UsageError);
  EXPECT_THAT(faults("", "mass_g: 50, friction: -1"), ElementsAre(HasSubstr("object.friction: -1 is outside")));
}

TEST(GraspSpec, TheCenterOfMassMayLieBesideThatOfTheSolidWithinItsBox) {
  const TriangleMesh box = centered_box(Vector3(0.01, 0.015, 0.02));
  const GraspSpec spec = read("grip_mm: [0, 0, 5]", "mass_g: 50, center_of_mass_shift_mm: [2, 0, -3]");
  const MassProperties mass = spec.mass_of(box), solid = mass_properties(box.positions, box.triangles);
  EXPECT_LT((mass.center_m - Vector3(2e-3, 0.0, -3e-3)).norm(), 1e-12);
  EXPECT_EQ(mass.second_moment_m2, solid.second_moment_m2);
  // grip_mm is measured from the solid's centre, so that the place stays while the lever changes.
  const GraspPose pose = spec.pose_of(box, mass, {}, 0.5);
  EXPECT_LT((mass.center_m + pose.grip_m - Vector3(0.0, 0.0, 5e-3)).norm(), 1e-12);
  EXPECT_NEAR(pose.lever_m(), 8e-3, 1e-12);
  const GraspSpec outside = read("", "mass_g: 50, center_of_mass_shift_mm: [0, 16, 0]");
  EXPECT_THROW(outside.mass_of(box), DataError);
  EXPECT_THAT(faults("", "mass_g: 50, center_of_mass_shift_mm: [1, 2]"),
              ElementsAre(HasSubstr("object.center_of_mass_shift_mm")));
}

TEST(GraspSpec, VectorsHaveThreeNumbers) {
  EXPECT_THAT(faults("grip_mm: [1, 2]", "mass_g: 50"), ElementsAre(HasSubstr("fingers.grip_mm")));
  EXPECT_THAT(faults("gravity_m_s2: [1]", "mass_g: 50"), ElementsAre(HasSubstr("fingers.gravity_m_s2")));
}

}  // namespace grasp_spec_test
}  // namespace tacipc
