#include "stages/robot/robot/run.h"

#include <gmock/gmock.h>

#include <cmath>

#include "common/base/error.h"
#include "common/stage/stage.h"
#include "stages/robot/robot/outputs.h"
#include "tests/make_mesh.h"
#include "tests/stages/robot/robot/small_robots.h"

namespace tacipc {
namespace run_test {

using ::testing::HasSubstr;

constexpr double kGravity_m_s2 = 9.81, kStep_s = 0.001;
const std::string kAlone = kPadLooksDown + kPlateObject;
const RobotProgress kQuiet = [](double) {};

RobotRun alone(const std::string& model, const std::string& text) {
  const ScratchFolder folder;
  const TaskSpec task = written_task(folder, model, text);
  RobotModel robot(task, {{}}, false);
  return run_alone(task, robot, kQuiet);
}

TEST(RunAlone, FallsAsTheIntegratorHasIt) {
  const RobotRun run = alone(mjcf(kPlate + falling_pad(0.5)), kAlone + "steps: {seconds: 0.1}\n");
  EXPECT_TRUE(run.finished);
  ASSERT_EQ(run.frames.size(), 11u);
  for (std::size_t f = 0; f < run.frames.size(); ++f) {
    const RobotFrame& frame = run.frames[f];
    EXPECT_EQ(frame.time_s, static_cast<double>(f) * 0.01);
    // Semi-implicit Euler: v = −g t, z = −g h² n (n + 1)/2.
    const double n = 10.0 * static_cast<double>(f);
    const double way = -kGravity_m_s2 * kStep_s * kStep_s * n * (n + 1.0) / 2.0;
    EXPECT_NEAR(frame.qpos[0], way, 1e-12);
    EXPECT_NEAR(frame.qvel[0], -kGravity_m_s2 * frame.time_s, 1e-12);
    // The weight is the second body; its pad 10 mm below.
    EXPECT_NEAR(frame.body_pose[1](2, 3), 1.0 + way, 1e-12);
    EXPECT_NEAR(frame.pad_pose[0](2, 3), 0.99 + way, 1e-12);
    EXPECT_EQ(frame.pad_pose[0](2, 2), -1.0);
    EXPECT_NEAR(frame.body_twist[1].velocity_m_s.z(), frame.qvel[0], 1e-15);
    EXPECT_EQ(frame.pad_wrench[0].force_n, Vector3::Zero());
  }
  EXPECT_TRUE(run.events.empty());
}

TEST(RunAlone, ComesToRestOnAPlaneAndSaysWhenItTouched) {
  const RobotRun run =
      alone(mjcf(kPlate + R"(<geom name="floor" type="plane" size="1 1 1" pos="0 0 0.985"/>)" + falling_pad(0.5)),
            kAlone + "steps: {seconds: 1}\n");
  EXPECT_NEAR(run.frames.back().pad_wrench[0].force_n.z(), 0.5 * kGravity_m_s2, 1e-3);
  EXPECT_LT(run.frames.back().pad_wrench[0].torque_n_m.norm(), 1e-4);
  ASSERT_FALSE(run.events.empty());
  EXPECT_EQ(run.events[0].first, "floor");
  EXPECT_EQ(run.events[0].second, "pad");
  EXPECT_TRUE(run.events[0].begins);
  EXPECT_NEAR(run.events[0].time_s, std::sqrt(2.0 * 0.005 / kGravity_m_s2), 2 * kStep_s);
}

TEST(RunAlone, EndsWithAWholeFrameAfterTheLastStep) {
  EXPECT_EQ(
      alone(mjcf(kPlate + falling_pad(0.5)), kAlone + "steps: [{seconds: 0.012}, {seconds: 0.011}]\n").frames.size(),
      4u);
  EXPECT_EQ(alone(mjcf(kPlate + falling_pad(0.5)), kAlone + "frame_s: 0.001\nsteps: {seconds: 0.01}\n").frames.size(),
            11u);
}

TEST(RunAlone, FramesAreWholeNumbersOfTimeSteps) {
  EXPECT_THAT(message_of<UsageError>(
                  [] { alone(mjcf(kPlate + falling_pad(0.5)), kAlone + "frame_s: 0.0105\nsteps: {seconds: 1}\n"); }),
              HasSubstr("frame_s, 0.0105 s, is not a whole number of the model's time steps, 0.001 s"));
  EXPECT_THAT(message_of<UsageError>(
                  [] { alone(mjcf(kPlate + falling_pad(0.5)), kAlone + "frame_s: 0.0001\nsteps: {seconds: 1}\n"); }),
              HasSubstr("is not a whole number"));
  // As rounding has them.
  EXPECT_EQ(alone(mjcf(kPlate + falling_pad(0.5), "", R"(timestep="0.002")"), kAlone + "steps: {seconds: 0.1}\n")
                .frames.size(),
            11u);
}

TEST(RunAlone, AMotionThatBecomesUnstableIsAnError) {
  const std::string spring =
      R"(<actuator><general joint="z" gainprm="1e9" biastype="affine" biasprm="0 -1e9 0"/></actuator>)";
  EXPECT_THAT(
      message_of<DataError>([&] { alone(mjcf(kPlate + falling_pad(0.5), spring), kAlone + "steps: {seconds: 1}\n"); }),
      testing::ContainsRegex("the motion became unstable at 0\\.00[2-9] s"));
}

/// A weight on a spring between answers that stay: it is set on a gel at rest.
class Windows : public testing::Test {
 protected:
  Windows()
      : task_(written_task(
            folder_,
            mjcf(kPlate + R"(<geom name="floor" type="plane" size="1 1 1" pos="0 0 0.5"/>)" +
                     falling_pad(0.5, "damping=\"3\"") +
                     R"(<body name="ball" pos="0.3 0 0.53"><joint type="slide" axis="0 0 1"/>
                      <joint type="hinge" axis="1 0 0"/>
                                             <geom name="ball" size="0.02" mass="0.1"/></body>)",
                 R"(<actuator><general name="z" joint="z" gainprm="800" biastype="affine"
                                                 biasprm="0 -800 -2"/></actuator>)"),
            kAlone + "steps:\n  - {seconds: 0.035, set: {z: -0.01}}\n  - {seconds: 0.4, limit: {z: 4}, set: {z: "
                     "-0.02}}\n")) {}

  Window window(int frames, const RobotRun* before) {
    PadAnswer answer{.gap_m = 0.004};
    answer.world_from_gel.diagonal() << 1, -1, -1, 1;
    answer.world_from_gel(2, 3) = 0.99;
    return {.before = before, .answers = nullptr, .at_start = {answer}, .frames = frames, .stiffness_n_m = 2e4};
  }

  ScratchFolder folder_;
  TaskSpec task_;
};

void expect_same(const RobotRun& a, const RobotRun& b) {
  EXPECT_EQ(a.state, b.state);
  EXPECT_EQ(a.finished, b.finished);
  ASSERT_EQ(a.frames.size(), b.frames.size());
  for (std::size_t f = 0; f < a.frames.size(); ++f) {
    EXPECT_EQ(a.frames[f].time_s, b.frames[f].time_s);
    EXPECT_EQ(a.frames[f].step, b.frames[f].step);
    EXPECT_EQ(a.frames[f].qpos, b.frames[f].qpos);
    EXPECT_EQ(a.frames[f].qvel, b.frames[f].qvel);
    EXPECT_EQ(a.frames[f].control, b.frames[f].control);
    EXPECT_EQ(a.frames[f].actuator_force, b.frames[f].actuator_force);
    EXPECT_EQ(a.frames[f].body_pose, b.frames[f].body_pose);
    EXPECT_EQ(a.frames[f].pad_pose, b.frames[f].pad_pose);
    for (std::size_t p = 0; p < a.frames[f].pad_wrench.size(); ++p) {
      EXPECT_EQ(a.frames[f].pad_wrench[p].force_n, b.frames[f].pad_wrench[p].force_n);
      EXPECT_EQ(a.frames[f].pad_wrench[p].torque_n_m, b.frames[f].pad_wrench[p].torque_n_m);
    }
    for (std::size_t k = 0; k < a.frames[f].body_twist.size(); ++k) {
      EXPECT_EQ(a.frames[f].body_twist[k].velocity_m_s, b.frames[f].body_twist[k].velocity_m_s);
      EXPECT_EQ(a.frames[f].body_twist[k].spin_rad_s, b.frames[f].body_twist[k].spin_rad_s);
    }
  }
  ASSERT_EQ(a.events.size(), b.events.size());
  for (std::size_t e = 0; e < a.events.size(); ++e) {
    EXPECT_EQ(a.events[e].time_s, b.events[e].time_s);
    EXPECT_EQ(a.events[e].first, b.events[e].first);
    EXPECT_EQ(a.events[e].second, b.events[e].second);
    EXPECT_EQ(a.events[e].begins, b.events[e].begins);
  }
}

TEST_F(Windows, InPiecesWithFilesInBetweenAreTheSameBits) {
  RobotModel robot(task_, {{}}, true);
  const RobotRun whole = run_window(task_, robot, window(50, nullptr));
  // The first event is the ball's; the pad meets the gel.
  EXPECT_GE(whole.events.size(), 2u);
  EXPECT_LT(whole.frames.back().pad_wrench[0].force_n.z(), 20.0);
  EXPECT_GT(whole.frames.back().pad_wrench[0].force_n.z(), 1.0);
  EXPECT_TRUE(whole.finished);
  EXPECT_EQ(whole.frames.size(), 45u);  // 0.435 s, and the frame that it ends in
  std::optional<RobotRun> before;
  for (const int frames : {3, 1, 7, 20, 20}) {
    RobotModel fresh(task_, {{}}, true);
    const RobotRun piece = run_window(task_, fresh, window(frames, before ? &*before : nullptr));
    const StageSpec spec{.name = "robot", .summary = "", .inputs = {}};
    const std::string out = (folder_ / "out").string();
    std::vector<std::string> words{"robot", "--out", out};
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    ASSERT_EQ(run_stage(spec, static_cast<int>(argv.size()), argv.data(),
                        [&](Stage& stage) {
                          write_outputs(stage, task_, {{}}, fresh, {Matrix4::Identity()}, piece, nullptr);
                        }),
              0);
    before = read_run(out);
    before->finished = piece.finished;
  }
  expect_same(*before, whole);
}

TEST_F(Windows, ATryChangesNothingOfWhatItBeganFrom) {
  RobotModel robot(task_, {{}}, true);
  const RobotRun first = run_window(task_, robot, window(10, nullptr));
  RobotModel other(task_, {{}}, true);
  const RobotRun once = run_window(task_, other, window(5, &first)),
                 twice = run_window(task_, other, window(5, &first));
  expect_same(once, twice);
  ASSERT_EQ(once.frames.size(), 16u);
  for (std::size_t f = 0; f < first.frames.size(); ++f) EXPECT_EQ(once.frames[f].qpos, first.frames[f].qpos);
}

TEST_F(Windows, ForcesLieOnTheLawOfTheLastAnswer) {
  RobotModel robot(task_, {{}}, true);
  const Window told = window(45, nullptr);
  const RobotRun run = run_window(task_, robot, told);
  int pressed = 0;
  for (std::size_t f = 1; f < run.frames.size(); ++f) {
    const RobotFrame& frame = run.frames[f];
    const Wrench law = felt_wrench(told.at_start[0], frame.pad_pose[0].topRightCorner<3, 1>(), told.stiffness_n_m);
    EXPECT_LT((frame.pad_wrench[0].force_n - law.force_n).norm(), 1e-5 * (1e-3 + law.force_n.norm())) << f;
    pressed += law.force_n.norm() > 0.0 ? 1 : 0;
  }
  EXPECT_GT(pressed, 10);
}

TEST_F(Windows, OneThatIsExactFeelsTheAnswersWhereverItGoes) {
  WindowAnswers answers{.frames = {}, .stiffness_n_m = {}, .inertia_n_m = {0.0}, .objects = {}, .floats = {}};
  for (int f = 0; f <= 4; ++f) {
    PadAnswer answer = window(4, nullptr).at_start[0];
    answer.wrench = {Vector3(0.1, 0, f), Vector3(0, 0.01, 0)};
    answers.frames.push_back({answer});
    answers.stiffness_n_m.push_back({2e4});
    answers.objects.emplace_back();
    answers.floats.push_back({false});
  }
  Window exact = window(4, nullptr);
  exact.answers = &answers;
  exact.exact = true;
  RobotModel robot(task_, {{}}, true);
  const RobotRun run = run_window(task_, robot, exact);
  ASSERT_EQ(run.frames.size(), 5u);
  double farthest = 0.0;
  for (std::size_t f = 1; f < run.frames.size(); ++f) {
    EXPECT_EQ(run.frames[f].pad_wrench[0].force_n, answers.frames[f][0].wrench.force_n);
    EXPECT_EQ(run.frames[f].pad_wrench[0].torque_n_m, answers.frames[f][0].wrench.torque_n_m);
    farthest = std::max(farthest, std::abs(run.frames[f].pad_pose[0](2, 3) - 0.99));
  }
  EXPECT_GT(farthest, 1e-4);
  EXPECT_DOUBLE_EQ(position_residual_m(run, 0, answers), farthest);
}

TEST(PositionResidual, CountsAWayAndATurnAndWantsAsManyFrames) {
  const auto residual = [](const Matrix4& pose, std::size_t frames) {
    RobotRun run;
    run.frames.resize(2);
    for (RobotFrame& frame : run.frames) frame.pad_pose = {Matrix4::Identity()};
    run.frames[1].pad_pose = {pose};
    WindowAnswers answers;
    answers.frames.assign(frames, {PadAnswer{}});
    return position_residual_m(run, 0, answers);
  };
  Matrix4 away = Matrix4::Identity(), turned = Matrix4::Identity();
  away(0, 3) = 3e-6;
  turned.topLeftCorner<3, 3>() = Eigen::AngleAxisd(2e-3, Vector3::UnitX()).toRotationMatrix();
  EXPECT_EQ(residual(Matrix4::Identity(), 2), 0.0);
  EXPECT_DOUBLE_EQ(residual(away, 2), 3e-6);
  EXPECT_NEAR(residual(turned, 2), 2e-5, 1e-10);  // of a point 10 mm away
  EXPECT_EQ(residual(away, 3), std::numeric_limits<double>::infinity());
}

TEST_F(Windows, AStateOfAnotherModelIsRefused) {
  RobotModel robot(task_, {{}}, true);
  RobotRun run = run_window(task_, robot, window(2, nullptr));
  run.state.pop_back();
  EXPECT_EQ(message_of<DataError>([&] { run_window(task_, robot, window(2, &run)); }),
            "a saved state is of another model");
}

TEST(JudgeTry, NeedsAsManyAnswersAsFrames) {
  RobotRun tried;
  tried.frames.resize(6);
  WindowAnswers answers;
  answers.frames.resize(3);
  EXPECT_EQ(message_of<DataError>([&] { judge_try({}, tried, 2, {}, 1.0, answers); }),
            "the press answered 5 frames, and its try has 6");
}

}  // namespace run_test
}  // namespace tacipc
