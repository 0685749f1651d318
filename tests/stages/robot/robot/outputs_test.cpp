#include "stages/robot/robot/outputs.h"

#include <gmock/gmock.h>

#include <numbers>

#include "common/base/error.h"
#include "common/config/config.h"
#include "common/format/npy.h"
#include "tests/make_mesh.h"
#include "tests/stages/robot/robot/small_robots.h"

namespace tacipc {
namespace outputs_test {

using ::testing::HasSubstr;

Matrix4 pose_at(const Vector3& at_m, double turn_rad, const Vector3& axis) {
  Matrix4 pose = Matrix4::Identity();
  pose.topLeftCorner<3, 3>() = Eigen::AngleAxisd(turn_rad, axis.normalized()).toRotationMatrix();
  pose.topRightCorner<3, 1>() = at_m;
  return pose;
}

/// A pad on a hinge, a cup that is held for 25 ms and a table.
class Outputs : public testing::Test {
 protected:
  Outputs()
      : task_(written_task(
            folder_,
            mjcf(R"(<body name="table" pos="0.1 0.2 -0.3" euler="0 0 35"><geom type="box" size="1 1 0.1"/></body>
                             <body name="cup" pos="0.1 -0.2 0.3" euler="10 -170 75"><freejoint/>
                               <geom size="0.01"/></body>
                             <body name="arm" pos="0.3 0.1 0.5" euler="20 30 40"><joint name="j" axis="0 1 0"/>
                               <geom name="pad" type="cylinder" size="0.01 0.005" pos="0.1 0 0" euler="0 90 0"/>
                             </body>)",
                 R"(<actuator><motor name="m" joint="j"/></actuator>)", R"(timestep="0.001" gravity="0 1 -3")"),
            "pads: {name: gel, geom: pad, at_mm: [1, 2, 5], turn_deg: [0, 20, 90]}\n"
            "objects:\n  - {name: cup, mesh: meshes/cup.off, unit: mm, mass_g: 20, held_s: 0.025}\n"
            "  - {name: table, kind: fixed, mesh: table.off}\n"
            "contact: [{between: [gel, cup], friction: 0.3, d_hat_mm: 0.02}]\nsteps: {seconds: 0.06}\n")),
        objects_{{make_box({-0.01, -0.01, -0.01}, {0.01, 0.01, 0.01}), 0.02},
                 {make_box({-1, -1, -0.1}, {1, 1, 0.1}), 0.0}},
        robot_(task_, objects_, true) {
    for (const std::size_t i : {0, 1}) start_.push_back(robot_.body_pose(robot_.object_body(i)));
  }

  RobotRun moved() {
    PadAnswer answer{.world_from_gel = robot_.pad_pose(0), .gap_m = 1.0};
    return run_window(task_, robot_,
                      {.at_start = {answer}, .objects_at_start = {start_[0]}, .frames = 10, .stiffness_n_m = 1e4});
  }

  void write(const RobotRun& run, const WindowAnswers* answers) {
    const StageSpec spec{.name = "robot", .summary = "", .inputs = {}};
    std::vector<std::string> words{"robot", "--out", out().string(), "--log-level", "off"};
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    ASSERT_EQ(run_stage(spec, static_cast<int>(argv.size()), argv.data(),
                        [&](Stage& stage) { write_outputs(stage, task_, objects_, robot_, start_, run, answers); }),
              0);
  }
  std::filesystem::path out() const { return folder_ / "runs/robot"; }

  ScratchFolder folder_;
  TaskSpec task_;
  std::vector<TaskObject> objects_;
  RobotModel robot_;
  std::vector<Matrix4> start_;
};

TEST_F(Outputs, TheSceneHasBodiesWhereTheRobotHasThem) {
  const RobotRun run = moved();
  ASSERT_EQ(run.frames.size(), 7u);
  write(run, nullptr);
  ConfigReader in = ConfigReader::from_file(out() / "scene.yaml");
  EXPECT_LT((in.vector3("gravity_m_s2") - Vector3(0, 1, -3)).norm(), 1e-15);
  std::vector<ConfigReader> bodies = in.sections("bodies");
  ASSERT_EQ(bodies.size(), 3u);
  EXPECT_EQ(bodies[0].text("name"), "gel");
  EXPECT_EQ(bodies[0].text("kind"), "gel");
  EXPECT_EQ(bodies[0].text("path"), "paths/gel.npy");
  for (const std::size_t i : {0, 1}) {
    ConfigReader& body = bodies[i + 1];
    const Vector3 turn = std::numbers::pi / 180.0 * body.vector3("turn_deg");
    const Matrix4 pose = pose_at(1e-3 * body.vector3("at_mm"), turn.norm(), turn);
    EXPECT_LT((pose - start_[i]).cwiseAbs().maxCoeff(), 1e-9);
  }
  EXPECT_EQ(bodies[1].text("kind"), "rigid");
  EXPECT_EQ(bodies[1].text("mesh"), "../../meshes/cup.off");
  EXPECT_EQ(bodies[1].text("unit"), "mm");
  EXPECT_NEAR(bodies[1].number("mass_g"), 20.0, 1e-12);
  EXPECT_EQ(bodies[2].text("kind"), "fixed");
  ConfigReader pair = in.sections("contact").at(0);
  EXPECT_EQ(pair.number("friction"), 0.3);
  EXPECT_EQ(pair.number("d_hat_mm"), 0.02);
  // Held for the frames that begin before 25 ms.
  std::vector<ConfigReader> motion = in.sections("motion");
  ASSERT_EQ(motion.size(), 2u);
  EXPECT_EQ(motion[0].integer("steps", 1), 3);
  EXPECT_TRUE(motion[0].has("hold"));
  EXPECT_EQ(motion[1].integer("steps", 1), 3);
  EXPECT_FALSE(motion[1].has("hold"));
}

TEST_F(Outputs, PathsAreThoseOfSInTheWorld) {
  const RobotRun run = moved();
  write(run, nullptr);
  const NpyArray path = read_npy(out() / "paths/gel.npy", {7, 4, 4});
  const int geom = robot_.id(mjOBJ_GEOM, "pad");
  auto data = robot_.make_data();
  for (std::size_t f = 0; f < 7; ++f) {
    // From the angles alone, by MuJoCo's quaternions.
    std::copy(run.frames[f].qpos.begin(), run.frames[f].qpos.end(), data->qpos);
    mj_kinematics(&robot_.model(), data.get());
    mjtNum wxyz[4];
    mju_mat2Quat(wxyz, data->geom_xmat + 9 * geom);
    Matrix4 geom_pose = Matrix4::Identity();
    geom_pose.topLeftCorner<3, 3>() = Eigen::Quaterniond(wxyz[0], wxyz[1], wxyz[2], wxyz[3]).toRotationMatrix();
    geom_pose.topRightCorner<3, 1>() = Eigen::Map<const Vector3>(data->geom_xpos + 3 * geom);
    const double deg = std::numbers::pi / 180.0;
    const Vector3 turn(0, 20 * deg, 90 * deg);
    const Matrix4 exact = geom_pose * pose_at({1e-3, 2e-3, 5e-3}, turn.norm(), turn);
    const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> written(path.data.data() + 16 * f);
    EXPECT_LT((written - exact).cwiseAbs().maxCoeff(), 1e-9) << f;
  }
  // It does move.
  EXPECT_GT(std::abs(run.frames[6].qpos[7] - run.frames[0].qpos[7]), 1e-3);
}

TEST_F(Outputs, AnswersThatAWindowBeganFromAreReadAsTheyWere) {
  WindowAnswers answers;
  for (int f = 0; f < 3; ++f) {
    PadAnswer& pad = answers.frames.emplace_back().emplace_back();
    pad.world_from_gel = pose_at({0.1 * f, 2, 3}, f, {1, 2, 3});
    pad.wrench = {{1.0 + f, 2, 3}, {4, 5, 6}};
    pad.gap_m = -0.1 * f;
  }
  write(moved(), &answers);
  const auto basis = read_basis(out(), 1);
  ASSERT_EQ(basis.size(), 3u);
  for (std::size_t f = 0; f < 3; ++f) {
    EXPECT_EQ(basis[f][0].world_from_gel, answers.frames[f][0].world_from_gel);
    EXPECT_EQ(basis[f][0].wrench.force_n, answers.frames[f][0].wrench.force_n);
    EXPECT_EQ(basis[f][0].wrench.torque_n_m, answers.frames[f][0].wrench.torque_n_m);
    EXPECT_EQ(basis[f][0].gap_m, answers.frames[f][0].gap_m);
  }
  EXPECT_TRUE(read_basis(folder_ / "", 1).empty());
}

/// What a press of this scene leaves, with its bodies in another order.
class PressAnswers : public Outputs {
 protected:
  PressAnswers() {
    folder_.file("press/press.yaml",
                 "stage: press\nsummary:\n  bodies:\n    - {name: cup, kind: rigid}\n    - {name: gel, kind: gel}\n"
                 "    - {name: table, kind: fixed}\n");
    std::vector<double> times, poses, wrenches(kFrames * 9 * 6, 0.0), energies(8 * kFrames, 0.0);
    for (std::size_t f = 0; f < kFrames; ++f) {
      times.push_back(0.01 * static_cast<double>(f));
      const double z = 0.02 + 1e-3 * static_cast<double>(f);
      for (const Vector3& at : {Vector3(0.1, 0, z), Vector3(0.1, 0, 0.008), Vector3(0, 0, -1.0)}) {
        const Matrix4 pose = pose_at(at, 0.0, {1, 0, 0});
        for (int i = 0; i < 16; ++i) poses.push_back(pose(i / 4, i % 4));
      }
      // On the gel by the cup, and less by the table.
      set(wrenches, f, 1, 0, {0, 0, -2}, {0, 0.3, 0});
      set(wrenches, f, 1, 2, {0, 0.5, 0}, {0, 0, 0});
      set(wrenches, f, 0, 1, {0, 0, 2}, {0, -0.3, 0});
    }
    write_npy(folder_ / "press/time.npy", {kFrames}, times.data());
    write_npy(folder_ / "press/body_pose.npy", {kFrames, 3, 4, 4}, poses.data());
    write_npy(folder_ / "press/pair_wrench.npy", {kFrames, 3, 3, 6}, wrenches.data());
    write_npy(folder_ / "press/energy.npy", {kFrames, 8}, energies.data());
  }
  static void set(std::vector<double>& all, std::size_t frame, std::size_t on, std::size_t by, const Vector3& force,
                  const Vector3& torque) {
    double* at = all.data() + 6 * (9 * frame + 3 * on + by);
    std::copy(force.begin(), force.end(), at);
    std::copy(torque.begin(), torque.end(), at + 3);
  }
  static constexpr std::size_t kFrames = 5;
};

TEST_F(PressAnswers, AreWrenchesAboutSOfAllThatTouchAGel) {
  const WindowAnswers answers = read_answers(folder_ / "press", task_, objects_, 2);
  ASSERT_EQ(answers.frames.size(), 3u);
  const PadAnswer& pad = answers.frames[0][0];
  EXPECT_EQ(pad.wrench.force_n, Vector3(0, 0.5, -2));
  // About the world's origin it was 0.3 N m about y; x × f = (0.1, 0, 0.008) × (0, 0.5, −2).
  EXPECT_LT((pad.wrench.torque_n_m - (Vector3(0, 0.3, 0) - Vector3(-0.004, 0.2, 0.05))).norm(), 1e-15);
  // The cup's lower face, 10 mm below its middle.
  EXPECT_NEAR(pad.gap_m, 0.022 - 0.01 - 0.008, 1e-12);
  EXPECT_NEAR(answers.frames[2][0].gap_m, 0.024 - 0.01 - 0.008, 1e-12);
  EXPECT_NEAR(answers.inertia_n_m[0], 0.02 / 1e-4, 1e-9);
  ASSERT_EQ(answers.objects[0].size(), 1u);
  EXPECT_NEAR(answers.objects[0][0](2, 3), 0.022, 1e-15);
}

TEST_F(PressAnswers, AnObjectGivesWayOnceItIsNoLongerHeld) {
  const WindowAnswers answers = read_answers(folder_ / "press", task_, objects_, 0);
  for (std::size_t f = 0; f < kFrames; ++f) EXPECT_EQ(answers.frames[f][0].carried, f < 4 ? -1 : 0) << f;
}

TEST_F(PressAnswers, AnObjectFloatsThatGelsAloneTouch) {
  WindowAnswers answers = read_answers(folder_ / "press", task_, objects_, 0);
  for (std::size_t f = 0; f < kFrames; ++f) EXPECT_EQ(answers.floats[f], (std::vector{f >= 4, false})) << f;
  NpyArray wrenches = read_npy(folder_ / "press/pair_wrench.npy");
  set(wrenches.data, 4, 0, 2, {0, 0, 1e-3}, {0, 0, 0});
  write_npy(folder_ / "press/pair_wrench.npy", wrenches.shape, wrenches.data.data());
  answers = read_answers(folder_ / "press", task_, objects_, 0);
  EXPECT_FALSE(answers.floats[4][0]);
  // It gives way as far as what else it touches lets it.
  EXPECT_EQ(answers.frames[4][0].carried, -1);
  EXPECT_TRUE(answers.frames[4][0].may_slide);
  EXPECT_FALSE(answers.frames[3][0].may_slide);
}

TEST_F(PressAnswers, AGelThatIsNotPressedHasTheNearestObjectBeforeIt) {
  NpyArray wrenches = read_npy(folder_ / "press/pair_wrench.npy");
  std::fill(wrenches.data.begin(), wrenches.data.end(), 0.0);
  write_npy(folder_ / "press/pair_wrench.npy", wrenches.shape, wrenches.data.data());
  EXPECT_EQ(read_answers(folder_ / "press", task_, objects_, 4).frames[0][0].carried, 0);
  EXPECT_EQ(read_answers(folder_ / "press", task_, objects_, 3).frames[0][0].carried, -1);
}

TEST_F(PressAnswers, OfOtherBodiesOrTooFewFramesAreRefused) {
  EXPECT_THAT(message_of<DataError>([&] { read_answers(folder_ / "press", task_, objects_, 5); }),
              HasSubstr("has 5 frames, and the window begins after frame 5"));
  task_.pads[0].name = "finger";
  EXPECT_THAT(message_of<DataError>([&] { read_answers(folder_ / "press", task_, objects_, 0); }),
              HasSubstr("has no body finger"));
}

TEST_F(PressAnswers, GapIsToTheNearestObjectAndANumberWhereThereIsNone) {
  const std::vector<Matrix4> poses{pose_at({0, 0, 0.03}, 0.0, {1, 0, 0}), pose_at({0, 0, 0.5}, 0.0, {1, 0, 0})};
  EXPECT_NEAR(gap_of(task_, objects_, 0, Matrix4::Identity(), poses), 0.02, 1e-15);
  EXPECT_NEAR(gap_of(task_, objects_, 0, pose_at({0.5, 0, 0}, 0.0, {1, 0, 0}), poses), 0.4, 1e-15);
  EXPECT_EQ(gap_of(task_, objects_, 0, pose_at({5, 0, 0}, 0.0, {1, 0, 0}), poses), 1.0);
}

}  // namespace outputs_test
}  // namespace tacipc
