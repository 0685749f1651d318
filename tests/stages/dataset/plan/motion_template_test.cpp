#include "stages/dataset/plan/motion_template.h"

#include <gmock/gmock.h>

#include "tests/config_text.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace motion_template_test {

using testing::ElementsAre;

std::string drawn(const std::string& text, std::vector<double> u) {
  const auto motion = config_from_text<MotionTemplate>(text, "m.yaml");
  EXPECT_EQ(motion.dimensions(), static_cast<int>(u.size()));
  return motion.sample_yaml([&](int d) { return u.at(static_cast<std::size_t>(d)); },
                            [](int phase) { return "path_" + std::to_string(phase); }, 7);
}

TEST(MotionTemplate, RangesAreDrawnAndNumbersStay) {
  EXPECT_EQ(drawn(R"(placement: {center_mm: {x: [-2, 2], y: 1}, rotate_deg: [0, 360], face: "+z", may_miss: true}
object: {density_kg_m3: 7800}
motion:
  - {kind: press, depth_mm: [0.2, 0.6], steps: 3}
  - {kind: shear, distance_mm: 0.5, direction_deg: [0, 100], steps: 4, substeps: 2}
  - {kind: load, force_n: [0, 0, -2], free: z, steps: 1}
  - {kind: release, steps: 2}
)",
                  {0.75, 0.5, 0.25, 0.1}),
            R"(placement:
  center_mm: [1, 1]
  rotate_deg: 180
  face: "+z"
  may_miss: true
object: {density_kg_m3: 7800}
motion:
  - {kind: press, depth_mm: 0.3, steps: 3, substeps: 1}
  - {kind: shear, distance_mm: 0.5, direction_deg: 10, steps: 4, substeps: 2}
  - {kind: load, force_n: [0, 0, -2], free: z, steps: 1, substeps: 1}
  - {kind: release, steps: 2, substeps: 1}
)");
}

TEST(MotionTemplate, AFileForPressIsAMotionWithoutRanges) {
  EXPECT_EQ(drawn("object: {density_kg_m3: 1000}\nmotion: {kind: press, force_n: 2, steps: 3}\n", {}),
            "placement:\n  center_mm: [0, 0]\n  rotate_deg: 0\nobject: {density_kg_m3: 1000}\n"
            "motion:\n  - {kind: press, force_n: 2, steps: 3, substeps: 1}\n");
}

TEST(MotionTemplate, AFreeObjectHasADensityAndPerhapsAForce) {
  EXPECT_THAT(
      drawn("object: {density_kg_m3: 1000}\nmotion: [{kind: free, steps: 3}, {kind: free, force_n: [0, 0.5, 0], "
            "steps: 1}]\n",
            {}),
      testing::EndsWith("motion:\n  - {kind: free, steps: 3, substeps: 1}\n"
                        "  - {kind: free, force_n: [0, 0.5, 0], steps: 1, substeps: 1}\n"));
  // Not only when the first sample is pressed.
  EXPECT_THAT(faults_in<MotionTemplate>(
                  "motion: [{kind: free, steps: 3}, {kind: load, force_n: [0, 0, -1], steps: 1}]\n", "m.yaml"),
              ElementsAre(testing::HasSubstr("motion[0].kind: the object is free only if"),
                          testing::HasSubstr("motion[1].force_n: a force moves the object only if")));
}

TEST(MotionTemplate, APathHasAsManyFramesAsRowsAfterItsFirst) {
  const ScratchFolder scratch;
  for (const char* rows : {"t,x,y,z,qx,qy,qz,qw\n0,0,0,0,0,0,0,1\n\n1,0,0,-1,0,0,0,1\n2,0,0,-2,0,0,0,1",
                           "0,0,0,0,0,0,0,1\n1,0,0,-1,0,0,0,1\r\n2,0,0,-2,0,0,0,1\n"}) {
    scratch.file("p.csv", rows);
    const auto motion = config_from_text<MotionTemplate>("motion: [{kind: path, file: p.csv}]\n", scratch / "m.yaml");
    EXPECT_EQ(motion.frames(), 2) << rows;
    EXPECT_EQ(motion.phases[0].path_file, scratch / "p.csv");
    EXPECT_THAT(motion.sample_yaml([](int) { return 0.0; }, [](int) { return "x/p.csv"; }, 0),
                testing::HasSubstr("{kind: path, file: x/p.csv, relative_to: placement, substeps: 1}"));
  }
}

TEST(MotionTemplate, AGraspIsDrawnWithASeedOfItsOwn) {
  EXPECT_EQ(drawn(R"(fingers: {draw: {best_of: 3, patch_mm: 4}, closing_speed_mm_s: [10, 20]}
object: {friction_margin: [0.5, 4.5]}
motion:
  - {kind: close, force_n: [1, 3], steps: 4}
  - {kind: lift, distance_mm: 10, steps: 5, substeps: 2}
  - {kind: shake, amplitude_mm: [2, 4], frequency_hz: 2.5, axis: y, steps: 8}
  - {kind: hold, steps: 2}
  - {kind: release, distance_mm: 1, steps: 3}
)",
                  {0.5, 0.5, 0.25, 0.75}),
            R"(fingers:
  draw: {seed: 7, best_of: 3, upright: false, width_mm: [0.5, 80], patch_mm: 4, depth_mm: 0.5}
  closing_speed_mm_s: 15
  gravity_m_s2: [0, 0, -9.81]
object: {friction_margin: 1.5}
motion:
  - {kind: close, force_n: 1.5, steps: 4, substeps: 1}
  - {kind: lift, distance_mm: 10, steps: 5, substeps: 2}
  - {kind: shake, amplitude_mm: 3.5, frequency_hz: 2.5, axis: y, steps: 8, substeps: 1}
  - {kind: hold, steps: 2, substeps: 1}
  - {kind: release, distance_mm: 1, steps: 3, substeps: 1}
)");
}

TEST(MotionTemplate, AGraspThatIsGivenMayBeMoved) {
  EXPECT_EQ(drawn("fingers: {rotation_xyzw: [1, 0, 0, 0], turn_deg: [0, 90], grip_mm: {x: [-2, 2], z: 1}}\n"
                  "object: {mass_g: [20, 40]}\nmotion: {kind: close, force_n: 1, steps: 4}\n",
                  {0.75, 0.5, 0.25}),
            "fingers:\n  grip_mm: [1, 0, 1]\n  turn_deg: 45\n  closing_speed_mm_s: 20\n  rotation_xyzw: [1, 0, 0, 0]\n"
            "  gravity_m_s2: [0, 0, -9.81]\nobject: {mass_g: 25}\n"
            "motion:\n  - {kind: close, force_n: 1, steps: 4, substeps: 1}\n");
}

TEST(MotionTemplate, FrictionAndCenterOfMassOfAGraspAreDrawnAfterItsWeight) {
  EXPECT_EQ(
      drawn("fingers: {grip_mm: [0, 0, 1]}\nobject: {friction_margin: [0.5, 2], friction: [0.2, 1], "
            "center_of_mass_shift_mm: {x: [-5, 5], z: 1}}\nmotion: {kind: close, force_n: 1, steps: 4}\n",
            {0.5, 0.25, 0.75}),
      "fingers:\n  grip_mm: [0, 0, 1]\n  turn_deg: 0\n  closing_speed_mm_s: 20\n  rotation_xyzw: [0, 0, 0, 1]\n"
      "  gravity_m_s2: [0, 0, -9.81]\nobject: {friction_margin: 1, friction: 0.4, center_of_mass_shift_mm: [2.5, 0, "
      "1]}\nmotion:\n  - {kind: close, force_n: 1, steps: 4, substeps: 1}\n");
  EXPECT_THAT(faults_in<MotionTemplate>("fingers: {}\nobject: {mass_g: 20, friction: [0.5, 11]}\n"
                                        "motion: {kind: close, force_n: 1, steps: 4}\n",
                                        "m.yaml"),
              ElementsAre(testing::HasSubstr("object.friction")));
}

TEST(MotionTemplate, FaultsOfAGraspAreSaidBeforeAnythingIsPressed) {
  EXPECT_THAT(faults_in<MotionTemplate>(R"(fingers: {draw: {seed: 3}, turn_deg: 4}
placement: {rotate_deg: 3}
object: {mass_g: 20, density_kg_m3: 1000}
motion:
  - {kind: lift, distance_mm: 3, steps: 2}
  - {kind: press, depth_mm: 1, steps: 1}
)",
                                        "m.yaml"),
              testing::IsSupersetOf({testing::HasSubstr("fingers.draw.seed: unknown key"),
                                     testing::HasSubstr("fingers.turn_deg: is drawn"),
                                     testing::HasSubstr("placement: fingers hold the object"),
                                     testing::HasSubstr("give one of mass_g, friction_margin, density_kg_m3"),
                                     testing::HasSubstr("motion[0].kind: fingers close first"),
                                     testing::HasSubstr("'press' is not one of close, lift, shake, hold, release")}));
  EXPECT_THAT(faults_in<MotionTemplate>("fingers: {rotation_xyzw: [1, 1, 0, 0]}\nobject: {mass_g: 20}\n"
                                        "motion: {kind: close, force_n: 1, steps: 4}\n",
                                        "m.yaml"),
              ElementsAre(testing::HasSubstr("fingers.rotation_xyzw: is no unit quaternion")));
}

TEST(MotionTemplate, MaxDepthIsThatOfTheDeepestPress) {
  const auto motion = config_from_text<MotionTemplate>(
      "motion: [{kind: press, depth_mm: [0.2, 0.6], steps: 1}, {kind: press, depth_mm: 0.5, steps: 2}]\n", "m.yaml");
  EXPECT_EQ(motion.max_depth_mm(), 0.6);
  EXPECT_EQ(motion.frames(), 3);
}

TEST(MotionTemplate, FaultsAreSaidAtTheirPlace) {
  EXPECT_THAT(faults_in<MotionTemplate>(R"(placement: {center_mm: {x: [2, -2], y: 0}}
object: {density_kg_m3: 1000}
motion:
  - {kind: press, depth_mm: [0, 1], steps: 1}
  - {kind: press, depth_mm: 1, force_n: 1, steps: 1}
  - {kind: shear, depth_mm: 1, steps: 1}
  - {kind: path, file: none.csv}
)",
                                        "m.yaml"),
              ElementsAre("m.yaml:1:28: placement.center_mm.x: a range goes from the lower to the higher number",
                          testing::HasSubstr("motion[0].depth_mm[0]: 0 is outside"),
                          testing::HasSubstr("motion[1].force_n: a press has a depth_mm or a force_n, not both"),
                          testing::HasSubstr("motion[2].distance_mm: missing"),
                          testing::HasSubstr("motion[2].depth_mm: unknown key"),
                          testing::HasSubstr("motion[3].file: none.csv does not exist")));
}

}  // namespace motion_template_test
}  // namespace tacipc
