#include "stages/dataset/report/robot_part.h"

#include <gmock/gmock.h>

#include "common/base/error.h"
#include "stages/dataset/report/chart.h"
#include "stages/dataset/report/scene_part.h"
#include "tests/stages/dataset/report/robot_scene.h"

namespace tacipc {
namespace robot_part_test {

using ::testing::HasSubstr;
using ::testing::Not;

class RobotPartTest : public ::testing::Test {
 protected:
  void SetUp() override { write_robot_scene(scratch_); }
  RobotReport robot() { return *read_robot_report(scratch_ / "bodies"); }
  SceneReport scene() { return read_scene(scratch_ / "bodies"); }
  std::string page(bool pictures = false) {
    return robot_sections(robot(), scene().bodies, steps_over_time(robot(), scene().frames), pictures);
  }

  ScratchFolder scratch_;
};

TEST_F(RobotPartTest, AForceHasAPartIntoThePadAndOneAlongIt) {
  Matrix4 sideways = Matrix4::Identity();
  sideways.topLeftCorner<3, 3>() << 0, 0, 1, 0, 1, 0, -1, 0, 0;  // looks along x
  const PadForce force = pad_force(sideways, {-2, 3, 4});
  EXPECT_DOUBLE_EQ(force.normal_n, 2.0);
  EXPECT_DOUBLE_EQ(force.tangential_n, 5.0);
}

TEST_F(RobotPartTest, WhatTheRobotFeltIsSetBesideWhatTheGelAnswers) {
  const std::vector<PadForces> pads = pad_forces(robot(), scene().bodies);
  ASSERT_EQ(pads.size(), 1u);
  EXPECT_EQ(pads[0].pad, "pad");
  EXPECT_DOUBLE_EQ(pads[0].answered[1].normal_n, 2.0);
  EXPECT_DOUBLE_EQ(pads[0].answered[1].tangential_n, 0.0);
  EXPECT_DOUBLE_EQ(pads[0].felt[1].normal_n, 2.0);
  EXPECT_DOUBLE_EQ(pads[0].felt[1].tangential_n, 0.25);
  EXPECT_DOUBLE_EQ(pads[0].apart_n, 0.25);
  EXPECT_EQ(first_contact(scene().bodies), 1);
}

TEST_F(RobotPartTest, StepsOfTheTaskArePhases) {
  const std::vector<Instant> frames = steps_over_time(robot(), scene().frames);
  EXPECT_EQ(frames[0].phase, "1 grip");
  EXPECT_EQ(frames[1].phase, "2 move");
  EXPECT_EQ(message_of<DataError>([&] {
              steps_over_time(robot(), {{0.0, ""}});
            }),
            "robot: has 2 frames, and its scene 1");
}

TEST_F(RobotPartTest, AFrameAfterTheLastStepBelongsToIt) {
  RobotReport over = robot();
  over.motion.frames[0].step = 1;
  over.motion.frames[1].step = 2;
  EXPECT_EQ(steps_over_time(over, scene().frames)[1].phase, "2 move");
}

TEST_F(RobotPartTest, TheKeyNamesTheColoursThatOccur) {
  const std::string key = picture_key({"gel", "fixed"}, false);
  EXPECT_THAT(key, HasSubstr("gel"));
  EXPECT_THAT(key, HasSubstr("fixed body"));
  EXPECT_THAT(key, Not(HasSubstr("free body")));
  EXPECT_THAT(key, Not(HasSubstr("robot")));
  EXPECT_THAT(picture_key({"gel", "rigid", "soft"}, true), HasSubstr("robot"));
}

TEST_F(RobotPartTest, APadThatIsNoGelOfTheSceneIsRefused) {
  RobotReport other = robot();
  other.motion.parts.pads[0] = "thumb";
  EXPECT_EQ(message_of<DataError>([&] { pad_forces(other, scene().bodies); }),
            "robot: its pad thumb is no body of the scene");
}

TEST_F(RobotPartTest, ThePageHasTheTaskItsForcesAndTheActuatorsThatChange) {
  const std::string html = page(true);
  EXPECT_THAT(html, HasSubstr("<h2>Task: pick</h2>"));
  EXPECT_THAT(html, HasSubstr("with seed 7"));
  EXPECT_THAT(html, HasSubstr("<b>50.0</b>mass_g"));
  EXPECT_THAT(html, HasSubstr("<img src=\"robot_strip.png\""));
  EXPECT_THAT(html, HasSubstr("They differ by at most 0.250 N"));
  EXPECT_THAT(html, HasSubstr("<b>Actuator grip</b>"));
  EXPECT_THAT(html, HasSubstr("control × 1000"));  // 0.01
  EXPECT_THAT(html, Not(HasSubstr("<b>Actuator idle</b>")));
  EXPECT_THAT(html, HasSubstr("way of " + curve_key(1) + "peg; turn of " + curve_key(2) + "peg"));
  EXPECT_THAT(html, HasSubstr("<title>2 move</title>"));
  EXPECT_THAT(html, Not(HasSubstr("nan")));
  EXPECT_THAT(page(), Not(HasSubstr("robot_strip.png")));
}

TEST_F(RobotPartTest, TheOutcomeIsThatOfTheRecord) {
  EXPECT_THAT(page(), Not(HasSubstr("in the hand and turned by")));  // a single gel
  RobotReport held = robot();
  held.held[0].outcome = "dropped";
  held.held[0].slip_m = 0.0123;
  held.held[0].turn_rad = 0.5;
  held.held[0].rise_m = -0.003;
  held.held[0].hand_rise_m = 0.04;
  EXPECT_THAT(robot_sections(held, scene().bodies, steps_over_time(held, scene().frames), false),
              HasSubstr("<p>peg: <b>dropped</b>. Since it was free it slipped by 12.30 mm in the hand and turned by "
                        "28.6°; it rose by -3.0 mm, the hand by 40.0 mm.</p>"));
  held.held[0].body = "cup";
  EXPECT_EQ(message_of<DataError>(
                [&] { robot_sections(held, scene().bodies, steps_over_time(held, scene().frames), false); }),
            "scene: its record holds cup, which is no body");
}

TEST_F(RobotPartTest, TriesAreSummedOverWindowsAndTheirHalves) {
  const CouplingSum sum = sum_of(robot().tries);
  EXPECT_EQ(sum.windows, 3);
  EXPECT_EQ(sum.tries, 7);
  EXPECT_EQ(sum.by_position, 1);
  EXPECT_EQ(sum.apart_m, 2.5e-6);
  EXPECT_EQ(sum.most_tries, 4);
  EXPECT_EQ(sum.cut, 1);
  EXPECT_EQ(sum.residual, 0.0015);
  const std::string html = page();
  EXPECT_THAT(html, HasSubstr("All 3 windows converged, with 7 tries in all and 4 in one at most, to a residual of "
                              "1.5e-03 or less; the tolerance is 0.002. In 1 of them the gels' answers jump"));
  EXPECT_THAT(html, HasSubstr("tolerance 0.002</text>"));
  EXPECT_THAT(html, HasSubstr("<title>window 2 of 2 frames, try 1: 0.05</title>"));
}

TEST_F(RobotPartTest, OfARobotAloneItIsSaidThatItDidNotFeelTheGels) {
  std::filesystem::remove(scratch_ / "bodies/residuals.csv");
  const std::string html = page();
  EXPECT_THAT(html, HasSubstr("as the robot felt it by MuJoCo's own contacts"));
  EXPECT_THAT(html, HasSubstr("it did not feel what they answer"));
  EXPECT_THAT(html, Not(HasSubstr("converged")));
}

}  // namespace robot_part_test
}  // namespace tacipc
