// Robot and press in turn, with gels whose forces are known in closed form.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tests/make_mesh.h"
#include "tests/stages/robot/robot/small_robots.h"
#include "tests/stages/robot/robot/spring_press.h"

namespace tacipc {
namespace coupling_physics_test {

constexpr double kGravity_m_s2 = 9.81;

// A weight of 0.5 kg on a vertical slide; the front of its pad begins 0.1 mm above a plate at 0.98 m.
const std::string kSetDown = kPadLooksDown + kPlateObject + "steps: {seconds: 1.5}\n";
SpringPress plate(double stiffness, double power) {
  return {.stiffness = stiffness, .power = power, .axis = Vector3::UnitZ(), .center_m = {0, 0, 0.9899}};
}

struct Robot {
  Robot(const std::string& model, const std::string& text, const std::vector<TaskObject>& objects = {{}})
      : task(written_task(folder, model, text)), robot(task, objects, true) {}
  ScratchFolder folder;
  TaskSpec task;
  RobotModel robot;
};

TEST(CoupledRobot, AWeightComesToRestAtTheDepthThatCarriesIt) {
  const double mass = 0.5, stiffness = 1e6, power = 1.5;
  Robot it(mjcf(kPlate + falling_pad(mass, "damping=\"20\"")), kSetDown);
  const CoupledRun run = couple(it.task, it.robot, plate(stiffness, power), 1e-3, 15);
  EXPECT_TRUE(run.run.finished);
  const double depth = std::pow(mass * kGravity_m_s2 / stiffness, 1.0 / power);
  const RobotFrame& last = run.run.frames.back();
  EXPECT_NEAR(0.9899 - last.pad_pose[0](2, 3), depth, 0.005 * depth);
  EXPECT_NEAR(last.pad_wrench[0].force_n.z(), mass * kGravity_m_s2, 0.005 * mass * kGravity_m_s2);
  EXPECT_LT(std::abs(last.qvel[0]), 1e-6);
}

// Two fingers of a hand that is fixed, fly or stand; they close on a block of 20 mm between them, each driven by a
// force.
std::string hand(double finger_kg, const std::string& palm) {
  const std::string mass = std::to_string(finger_kg);
  return kPlate + R"(<body name="block"><freejoint/><geom type="box" size="0.01 0.01 0.01" mass="1"/></body>
    <body name="palm">)" +
         palm + R"(
      <body name="left" pos="-0.011 0 0"><joint name="left" type="slide" axis="1 0 0" damping="2"/>
        <geom name="left_pad" type="box" size="0.001 0.01 0.01" pos="-0.001 0 0" mass=")" +
         mass + R"("/></body>
      <body name="right" pos="0.011 0 0"><joint name="right" type="slide" axis="-1 0 0" damping="2"/>
        <geom name="right_pad" type="box" size="0.001 0.01 0.01" pos="0.001 0 0" mass=")" +
         mass + R"("/></body></body>)";
}
const std::string kMotors =
    R"(<actuator><motor name="left" joint="left"/><motor name="right" joint="right"/></actuator>)";
const std::string kServos = R"(<actuator>
  <general name="left" joint="left" gainprm="2000" biastype="affine" biasprm="0 -2000 -30"/>
  <general name="right" joint="right" gainprm="2000" biastype="affine" biasprm="0 -2000 -30"/></actuator>)";
const std::string kFreeFall = R"(timestep="0.001" gravity="0 0 0")";
const std::string kFingers =
    "pads:\n  - {name: left, geom: left_pad, at_mm: [1, 0, 0], turn_deg: [0, 90, 0]}\n"
    "  - {name: right, geom: right_pad, at_mm: [-1, 0, 0], turn_deg: [0, -90, 0]}\n"
    "objects: {name: block, mesh: block.off, mass_g: 20}\n";
std::vector<TaskObject> block(double mass_kg) {
  return {{make_box({-0.01, -0.01, -0.01}, {0.01, 0.01, 0.01}), mass_kg}};
}
std::string grip(double control, double seconds) {
  const std::string value = std::to_string(control);
  return "steps:\n  - {seconds: 0.1, set: {left: " + value + ", right: " + value +
         "}}\n  - {seconds: " + std::to_string(seconds) + "}\n";
}
SpringPress held(double stiffness, double power, double mass_kg) {
  return {.stiffness = stiffness, .power = power, .half_m = 0.01, .mass_kg = mass_kg};
}

struct Case {
  const char* name;
  double stiffness, power, finger_kg, object_kg;
};
class CoupledGrip : public testing::TestWithParam<Case> {};

TEST_P(CoupledGrip, AgreesInFewTries) {
  const Case& c = GetParam();
  Robot it(mjcf(hand(c.finger_kg, ""), kServos, kFreeFall), kFingers + grip(0.0025, 0.2), block(c.object_kg));
  const CoupledRun run = couple(it.task, it.robot, held(c.stiffness, c.power, c.object_kg), 1e-3, 15);
  EXPECT_TRUE(run.run.finished);
  for (const double residual : run.residuals) EXPECT_LE(residual, 1e-3);
  const double mean = std::accumulate(run.tries.begin(), run.tries.end(), 0.0) / static_cast<double>(run.tries.size());
  EXPECT_LE(mean, 5.0);
  EXPECT_LE(*std::max_element(run.tries.begin(), run.tries.end()), 12);
  // At rest a servo of 2 kN/m and a gel share 1.5 mm of way.
  const double force = -run.run.frames.back().pad_wrench[0].force_n.x();
  const double depth = std::pow(force / c.stiffness, 1.0 / c.power);
  EXPECT_NEAR(2000.0 * (0.0025 - 0.001 - depth), force, 0.01 * force);
}

INSTANTIATE_TEST_SUITE_P(Gels, CoupledGrip,
                         testing::Values(Case{"stiff", 70e3, 1.0, 0.1, 0.05}, Case{"soft", 3e3, 1.0, 0.1, 0.05},
                                         Case{"curved", 1e6, 1.5, 0.1, 0.05},
                                         Case{"light_object", 70e3, 1.0, 0.1, 0.005},
                                         Case{"heavy_fingers", 2e4, 1.0, 1.0, 0.2}),
                         [](const auto& test) { return test.param.name; });

TEST(CoupledRobot, AFreeObjectIsCaughtFromOneSideInFewTriesOfLongWindows) {
  // Fingers driven by force alone meet an object that comes along, one after the other; the hand flies.
  const std::string palm = R"(<joint name="x" type="slide" axis="1 0 0"/><geom size="0.01" pos="0 0 0.1" mass="0.3"/>)";
  for (const double force : {0.3, 3.0, 6.0}) {
    for (const double stiffness : {2e3, 2e4, 7e4}) {
      Robot it(mjcf(hand(0.1, palm), kMotors, kFreeFall), kFingers + grip(force, 0.2), block(0.05));
      SpringPress press = held(stiffness, 1.0, 0.05);
      press.velocity_m_s = {0.03, 0, 0};
      const CoupledRun run = couple(it.task, it.robot, press, 1e-3, 15);
      EXPECT_TRUE(run.run.finished) << force << " N, " << stiffness << " N/m";
      EXPECT_LE(*std::max_element(run.tries.begin(), run.tries.end()), 3) << force << " N, " << stiffness << " N/m";
      EXPECT_NEAR(run.run.frames.back().pad_wrench[0].force_n.x(), -force, 0.02 * force);
    }
  }
}

TEST(CoupledRobot, AnswersWithTheWrongSignDoNotConverge) {
  const double mass = 0.5;
  Robot it(mjcf(kPlate + falling_pad(mass, "damping=\"20\"")), kSetDown);
  SpringPress wrong = plate(3e4, 1.0);
  const CoupledRun right = couple(it.task, it.robot, wrong, 1e-3, 15);
  EXPECT_TRUE(right.run.finished);
  wrong.sign = -1.0;
  Robot again(mjcf(kPlate + falling_pad(mass, "damping=\"20\"")), kSetDown);
  const CoupledRun run = couple(again.task, again.robot, wrong, 1e-3, 15);
  EXPECT_FALSE(run.run.finished);
  EXPECT_EQ(run.tries.back(), 15);
  EXPECT_GT(run.residuals.back(), 0.5);
}

TEST(CoupledRobot, WhatOneSideGetsTheOtherLoses) {
  const double object_kg = 0.05, finger_kg = 0.1, palm_kg = 0.3;
  // The hand flies along x; nothing outside pushes.
  const std::string palm = R"(<joint name="x" type="slide" axis="1 0 0"/><geom size="0.01" pos="0 0 0.1" mass="0.3"/>)";
  Robot it(mjcf(hand(finger_kg, palm), kMotors, kFreeFall), kFingers + grip(1.0, 0.2), block(object_kg));
  SpringPress press = held(2e4, 1.0, object_kg);
  // The object comes along, so both pads do not feel the same.
  press.velocity_m_s = {0.03, 0, 0};
  const CoupledRun run = couple(it.task, it.robot, press, 1e-5, 30);
  ASSERT_TRUE(run.run.finished);
  double felt = 0.0, answered = 0.0, most = 0.0;
  for (std::size_t f = 1; f < run.run.frames.size(); ++f) {
    for (std::size_t p = 0; p < 2; ++p) {
      felt += it.task.frame_s * run.run.frames[f].pad_wrench[p].force_n.x();
      answered += it.task.frame_s * run.answers[f][p].wrench.force_n.x();
      most += it.task.frame_s * std::abs(run.run.frames[f].pad_wrench[p].force_n.x());
    }
  }
  const RobotFrame& last = run.run.frames.back();
  // qvel: of the block's free joint, of the palm, of the fingers relative to it.
  const double v = last.qvel[6], left = last.qvel[7], right = -last.qvel[8];
  const double robot = (palm_kg + 2.0 * finger_kg) * v + finger_kg * (left + right);
  const double object = object_kg * (run.object_velocity_m_s.back().x() - 0.03);
  ASSERT_GT(most, 0.3);
  EXPECT_GT(std::abs(object), 1e-4);
  EXPECT_NEAR(object, -answered, 1e-9);
  EXPECT_NEAR(robot, felt, 1e-9);
  EXPECT_NEAR(robot + object, 0.0, 1e-5 * most);
}

}  // namespace coupling_physics_test
}  // namespace tacipc
