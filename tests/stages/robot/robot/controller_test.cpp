#include "stages/robot/robot/controller.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "common/base/error.h"
#include "tests/stages/robot/robot/small_robots.h"

namespace tacipc {
namespace controller_test {

using ::testing::HasSubstr;

// Three hinges about y and three at a wrist, servos on all; bent at the start.
const std::string kArm = R"(
  <body name="shoulder" pos="0 0 0.3"><joint name="j1" axis="0 0 1"/><geom type="sphere" size="0.03"/>
    <body name="upper"><joint name="j2" axis="0 1 0"/><geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02"/>
      <body name="lower" pos="0.3 0 0"><joint name="j3" axis="0 1 0"/>
        <geom type="capsule" fromto="0 0 0 0.25 0 0" size="0.02"/>
        <body name="w1" pos="0.25 0 0"><joint name="j4" axis="1 0 0"/><geom type="sphere" size="0.02"/>
          <body name="w2"><joint name="j5" axis="0 1 0"/><geom type="sphere" size="0.02"/>
            <body name="w3"><joint name="j6" axis="0 0 1"/>
              <geom name="pad" type="box" size="0.02 0.02 0.02" pos="0.05 0 0"/>
              <site name="tool" pos="0.08 0 0"/></body></body></body></body></body></body>)";

std::string servos(int count) {
  std::string all;
  for (int j = 1; j <= count; ++j) {
    const std::string name = "j" + std::to_string(j);
    all += "<general name=\"" + name + "\" joint=\"" + name +
           R"(" gainprm="1000" biastype="affine" biasprm="0 -1000 -50"/>)";
  }
  return "<actuator>" + all + R"(</actuator><keyframe><key qpos="0.1 -0.6 1.1 0.2 -0.4 0.1" ctrl="0.1 -0.6 1.1)" +
         std::string(count > 3 ? " 0.2 -0.4 0.1" : "") + "\"/></keyframe>";
}
const std::string kArmPads = "pads: {name: gel, geom: pad}\n" + kPlateObject;

/// A task with its robot and controller; nothing moves but by what a test does.
struct Told {
  Told(const std::string& model, const std::string& text)
      : task(written_task(folder, model, text)), robot(task, {{}}, false), controller(task, robot) {}

  /// Controls at an instant.
  std::vector<double> at(double time_s, std::vector<double> pads = {0.0}) {
    robot.data().time = time_s;
    controller.act(pads);
    return {robot.data().ctrl, robot.data().ctrl + robot.model().nu};
  }
  /// Where a site is with the servos where they are told to go.
  Matrix4 site() {
    const auto data = robot.make_data();
    std::copy_n(robot.data().ctrl, robot.model().nu, data->qpos);
    mj_kinematics(&robot.model(), data.get());
    const int s = robot.id(mjOBJ_SITE, "tool");
    return pose_from(data->site_xpos + 3 * s, data->site_xmat + 9 * s);
  }

  ScratchFolder folder;
  TaskSpec task;
  RobotModel robot;
  Controller controller;
};

TEST(Controller, MovesAPointAndTurnsItAsTold) {
  Told told(mjcf(kPlate + kArm, servos(6)),
            kArmPads + "steps:\n  - {seconds: 1, move: {site: tool, by_mm: [-30, 80, 40], turn_deg: [20, -10, 30]}}\n");
  told.at(0.0);
  const Matrix4 start = told.site();
  const Vector3 turn = std::numbers::pi / 180.0 * Vector3(20, -10, 30);
  for (const double time : {0.25, 0.5, 1.0}) {
    told.at(time);
    // Smooth: 3 s² − 2 s³ of the way, along a line and about one axis.
    const double share = time * time * (3.0 - 2.0 * time);
    const Matrix4 now = told.site();
    EXPECT_LT(((now - start).topRightCorner<3, 1>() - share * Vector3(-0.03, 0.08, 0.04)).norm(), 1e-6);
    const Matrix3 exact =
        Eigen::AngleAxisd(share * turn.norm(), turn.normalized()).toRotationMatrix() * start.topLeftCorner<3, 3>();
    EXPECT_LT((now.topLeftCorner<3, 3>() - exact).norm(), 1e-6);
  }
  EXPECT_TRUE(told.controller.done());
}

TEST(Controller, MovesAPointToAPlace) {
  Told told(mjcf(kPlate + kArm, servos(6)),
            kArmPads + "steps:\n  - {seconds: 1, move: {site: tool, to_mm: [400, 100, 350]}, smooth: false}\n");
  told.at(0.0);
  const Matrix4 start = told.site();
  told.at(0.5);
  const Vector3 way = Vector3(0.4, 0.1, 0.35) - start.topRightCorner<3, 1>();
  EXPECT_LT(((told.site() - start).topRightCorner<3, 1>() - 0.5 * way).norm(), 1e-6);
  told.at(1.0);
  EXPECT_LT((told.site().topRightCorner<3, 1>() - Vector3(0.4, 0.1, 0.35)).norm(), 1e-6);
  EXPECT_LT(((told.site() - start).topLeftCorner<3, 3>().norm()), 1e-6);
}

TEST(Controller, ShakesAPointThereAndBack) {
  Told told(mjcf(kPlate + kArm, servos(6)),
            kArmPads + "steps:\n  - {seconds: 1, shake: {site: tool, amplitude_mm: [0, 0, 4], frequency_hz: 2}}\n");
  told.at(0.0);
  const Matrix4 start = told.site();
  for (const auto& [time, height] : {std::pair{0.125, 0.002}, {0.25, 0.004}, {0.5, 0.0}, {1.0, 0.0}}) {
    told.at(time);
    EXPECT_LT((told.site().topRightCorner<3, 1>() - start.topRightCorner<3, 1>() - Vector3(0, 0, height)).norm(), 1e-6);
  }
}

TEST(Controller, AShakeEndsAtRestWhateverItsFrequency) {
  // 1.7 periods in its time are two.
  Told told(mjcf(kPlate + kArm, servos(6)),
            kArmPads + "steps:\n  - {seconds: 1, shake: {site: tool, amplitude_mm: [0, 0, 4], frequency_hz: 1.7}}\n");
  told.at(0.0);
  const Vector3 start = told.site().topRightCorner<3, 1>();
  const auto height = [&](double time) {
    told.at(time);
    return (told.site().topRightCorner<3, 1>() - start).z();
  };
  EXPECT_NEAR(height(0.25), 0.004, 1e-6);
  EXPECT_NEAR(height(0.5), 0.0, 1e-6);
  EXPECT_NEAR(height(0.999), 0.0, 4e-7);  // ½ a t²: it arrives without a speed
  EXPECT_NEAR(height(1.0), 0.0, 1e-9);
}

TEST(Controller, RefusesAPlaceBeyondAJointsRange) {
  const std::string hinge = R"(<joint name="j3" axis="0 1 0")";
  std::string arm = kArm;
  arm.insert(arm.find(hinge) + hinge.size(), R"( limited="true" range="60 70")");
  Told told(mjcf(kPlate + arm, servos(6)),
            kArmPads + "steps:\n  - {seconds: 1, move: {site: tool, by_mm: [-80, 0, 0]}}\n");
  told.at(0.0);
  EXPECT_THAT(
      message_of<DataError>([&] { told.at(1.0); }),
      testing::ContainsRegex("step 1: site tool cannot go there: at 1.000 s joint j3 would be at 1\\.[0-9]+, beyond"));
}

TEST(Controller, RefusesAPlaceOutOfReachAndATurnThatItsJointsLack) {
  Told far(mjcf(kPlate + kArm, servos(6)),
           kArmPads + "steps:\n  - {seconds: 1, move: {site: tool, to_mm: [900, 0, 300]}}\n");
  far.at(0.0);
  EXPECT_THAT(message_of<DataError>([&] { far.at(1.0); }), HasSubstr("step 1: site tool cannot go there: at 1.000 s"));
  Told stiff(mjcf(kPlate + kArm, servos(3)),
             kArmPads + "steps:\n  - {seconds: 1, move: {site: tool, turn_deg: [30, 0, 0]}}\n");
  stiff.at(0.0);
  EXPECT_THAT(message_of<DataError>([&] { stiff.at(1.0); }), HasSubstr("rad are missing"));
}

// Two slides with a servo each, and a motor.
const std::string kSlides =
    falling_pad(0.5) +
    R"(<body name="other"><joint name="x" type="slide" axis="1 0 0"/><geom size="0.01" mass="1"/>
                               <site name="tool" pos="0 0 0.1"/></body>)";
const std::string kDrives =
    R"(<actuator><general name="z" joint="z" gainprm="100" biastype="affine" biasprm="0 -100 -5"/>
         <motor name="push" joint="x"/></actuator>)";
const std::string kSlideTask = kPadLooksDown + kPlateObject;

TEST(Controller, ControlsGoFromWhereTheyAreInTheirTime) {
  Told told(mjcf(kPlate + kSlides, kDrives), kSlideTask +
                                                 "steps:\n  - {seconds: 2, set: {z: 8, push: -4}, smooth: false}\n"
                                                 "  - {seconds: 1, set: {z: 0}}\n");
  EXPECT_EQ(told.at(0.0), (std::vector{0.0, 0.0}));
  EXPECT_EQ(told.at(0.5), (std::vector{2.0, -1.0}));
  EXPECT_EQ(told.controller.step(), 0u);
  EXPECT_EQ(told.at(2.0), (std::vector{8.0, -4.0}));
  EXPECT_EQ(told.controller.step(), 1u);
  // Smooth, and what is not told stays.
  EXPECT_EQ(told.at(2.25), (std::vector{8.0 * (1.0 - 0.0625 * 2.5), -4.0}));
  EXPECT_EQ(told.at(3.0), (std::vector{0.0, -4.0}));
  EXPECT_TRUE(told.controller.done());
  EXPECT_EQ(told.at(4.0), (std::vector{0.0, -4.0}));
}

TEST(Controller, StepsShorterThanATimeStepArePassedAtOnce) {
  Told told(
      mjcf(kPlate + kSlides, kDrives),
      kSlideTask + "steps:\n  - {seconds: 1, set: {z: 8}}\n  - {seconds: 1e-12, set: {push: 3}}\n  - {seconds: 1}\n");
  told.at(0.0);
  EXPECT_EQ(told.at(1.0), (std::vector{8.0, 3.0}));
  EXPECT_EQ(told.controller.step(), 2u);
}

TEST(Controller, ALimitHoldsFromItsStepOn) {
  Told told(mjcf(kPlate + kSlides, kDrives),
            kSlideTask + "steps:\n  - {seconds: 1, set: {z: 8}}\n  - {seconds: 1, limit: {z: 3}}\n  - {seconds: 1}\n");
  const mjModel& m = told.robot.model();
  told.at(0.5);
  EXPECT_FALSE(m.actuator_forcelimited[0]);
  for (const double time : {1.0, 2.5}) {
    told.at(time);
    EXPECT_TRUE(m.actuator_forcelimited[0]);
    EXPECT_EQ(m.actuator_forcerange[0], -3.0);
    EXPECT_EQ(m.actuator_forcerange[1], 3.0);
    EXPECT_FALSE(m.actuator_forcelimited[1]);
  }
}

TEST(Controller, AForceEndsAStepAndItsControlsStay) {
  Told told(mjcf(kPlate + kSlides, kDrives),
            kSlideTask +
                "steps:\n  - {seconds: 4, set: {z: 8}, smooth: false, until: {pad: gel, "
                "force_n: 2}}\n  - {seconds: 1, set: {push: 1}, smooth: false}\n");
  EXPECT_EQ(told.at(0.0, {0.0}), (std::vector{0.0, 0.0}));
  EXPECT_EQ(told.at(1.0, {1.99}), (std::vector{2.0, 0.0}));
  EXPECT_EQ(told.at(1.5, {2.0}), (std::vector{2.0, 0.0}));
  EXPECT_EQ(told.controller.step(), 1u);
  EXPECT_EQ(told.at(2.0, {0.0}), (std::vector{2.0, 0.5}));
}

TEST(Controller, AHeightEndsAStep) {
  Told told(mjcf(kPlate + kSlides, kDrives),
            kSlideTask +
                "steps:\n  - {seconds: 4, until: {site: tool, above_mm: 100}}\n"
                "  - {seconds: 4, until: {site: tool, below_mm: 99}}\n  - {seconds: 1}\n");
  told.at(0.0);
  // It is 100 mm up.
  EXPECT_EQ(told.controller.step(), 1u);
  told.at(5.0);
  EXPECT_EQ(told.controller.step(), 2u);
}

TEST(Controller, NamesThatTheModelLacksAreSaid) {
  const ScratchFolder folder;
  const auto message = [&](const std::string& step) {
    const TaskSpec task =
        written_task(folder, mjcf(kPlate + kSlides, kDrives), kSlideTask + "steps: {seconds: 1, " + step + "}\n");
    RobotModel robot(task, {{}}, false);
    return message_of<UsageError>([&] { Controller(task, robot); });
  };
  const std::string file = (folder / "robot.xml").string();
  EXPECT_EQ(message("set: {y: 1}"), file + ": has no actuator 'y'; it has z, push");
  EXPECT_EQ(message("limit: {y: 1}"), file + ": has no actuator 'y'; it has z, push");
  EXPECT_EQ(message("move: {site: hand}"), file + ": has no site 'hand'; it has tool");
  EXPECT_EQ(message("shake: {site: hand, amplitude_mm: [1, 0, 0], frequency_hz: 1}"),
            file + ": has no site 'hand'; it has tool");
  EXPECT_EQ(message("until: {site: hand, above_mm: 1}"), file + ": has no site 'hand'; it has tool");
}

TEST(Controller, GoesOnFromASavedStateToTheSameBits) {
  const std::string text =
      kArmPads +
      "steps:\n  - {seconds: 0.5, limit: {j2: 50}}\n"
      "  - {seconds: 1, move: {site: tool, by_mm: [-30, 80, 40], turn_deg: [20, -10, 30]}, set: {j6: 1}}\n"
      "  - {seconds: 1, set: {j1: 0}}\n";
  Told one(mjcf(kPlate + kArm, servos(6)), text);
  one.at(0.0), one.at(0.6), one.at(0.9);
  const std::vector<double> saved = one.controller.state(),
                            control(one.robot.data().ctrl, one.robot.data().ctrl + one.robot.model().nu);
  Told other(mjcf(kPlate + kArm, servos(6)), text);
  std::copy(control.begin(), control.end(), other.robot.data().ctrl);
  other.controller.restore(saved);
  EXPECT_EQ(other.controller.state(), saved);
  EXPECT_EQ(other.robot.model().actuator_forcerange[3], 50.0);
  for (const double time : {1.0, 1.3, 1.7, 2.2}) EXPECT_EQ(one.at(time), other.at(time)) << time;
  EXPECT_EQ(message_of<DataError>([&] {
              other.controller.restore({saved.begin(), saved.end() - 1});
            }),
            "a saved state is of another model");
}

}  // namespace controller_test
}  // namespace tacipc
