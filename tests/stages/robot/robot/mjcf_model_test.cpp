#include "stages/robot/robot/mjcf_model.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "common/base/error.h"
#include "tests/make_mesh.h"
#include "tests/stages/robot/robot/small_robots.h"

namespace tacipc {
namespace mjcf_model_test {

using ::testing::HasSubstr;
using Matrix6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

const std::string kPadBody = falling_pad(0.5);
const std::string kOneStep = "steps: {seconds: 1}\n";

/// A free body with a box of MuJoCo's own, and what the task says of it.
std::string free_body(const std::string& attributes = "") {
  return "<body name=\"cup\" " + attributes +
         R"(><freejoint/><geom name="cup" type="box" size="0.1 0.2 0.3" mass="7"/></body>)";
}
std::string cup(const std::string& more = "") {
  return "objects: {name: cup, mesh: cup.off, mass_g: 60" + more + "}\n";
}

Matrix3 skew(const Vector3& v) {
  Matrix3 m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// Its mass matrix, of a model with this body alone on a free joint; angular velocities along the body's axes.
Matrix6 mass_matrix(const RobotModel& robot, int body) {
  const int nv = robot.model().nv;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> all(nv, nv);
  mj_fullM(&robot.model(), all.data(), robot.data().qM);
  const int at = robot.model().jnt_dofadr[robot.model().body_jntadr[body]];
  return all.block<6, 6>(at, at);
}

TEST(RobotModel, GivesAnObjectMassCentreAndInertiaOfItsMesh) {
  const ScratchFolder folder;
  const Vector3 sides(0.02, 0.04, 0.06), center(0.003, -0.005, 0.007);
  const double mass = 0.06;
  Matrix3 inertia = Matrix3::Zero();
  for (int k = 0; k < 3; ++k) inertia(k, k) = mass / 12.0 * (sides.squaredNorm() - sides[k] * sides[k]);
  // The body's geom alone would have its centre in the body's origin, axes along the body's.
  const TaskSpec task = written_task(folder, mjcf(kPadBody + free_body()), kPadLooksDown + cup() + kOneStep);
  const RobotModel robot(task, {{make_box(center - sides / 2, center + sides / 2), mass}}, false);
  const int body = robot.object_body(0);
  EXPECT_DOUBLE_EQ(robot.model().body_mass[body], mass);
  const Vector3 at(robot.data().xipos[3 * body], robot.data().xipos[3 * body + 1], robot.data().xipos[3 * body + 2]);
  EXPECT_LT((at - center).norm(), 1e-15);
  // Kinetic energy of velocity v of the origin and spin ω: ½ m |v + ω × c|² + ½ ωᵀ I ω.
  Matrix6 exact;
  const Matrix3 arm = skew(center);
  exact << mass * Matrix3::Identity(), -mass * arm, mass * arm, inertia - mass * arm * arm;
  EXPECT_LT((mass_matrix(robot, body) - exact).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(RobotModel, GivesATurnedBoxItsPrincipalAxes) {
  const ScratchFolder folder;
  const Vector3 sides(0.02, 0.04, 0.06);
  const double mass = 0.06;
  TriangleMesh box = make_box(-sides / 2, sides / 2);
  const Matrix3 turn = Eigen::AngleAxisd(0.7, Vector3(1, 2, -1).normalized()).toRotationMatrix();
  for (Eigen::Index v = 0; v < box.num_vertices(); ++v)
    box.positions.row(v) = (turn * Vector3(box.positions.row(v))).transpose();
  Matrix3 inertia = Matrix3::Zero();
  for (int k = 0; k < 3; ++k) inertia(k, k) = mass / 12.0 * (sides.squaredNorm() - sides[k] * sides[k]);
  const TaskSpec task = written_task(folder, mjcf(kPadBody + free_body()), kPadLooksDown + cup() + kOneStep);
  const RobotModel robot(task, {{box, mass}}, false);
  Matrix6 exact = Matrix6::Zero();
  exact.topLeftCorner<3, 3>() = mass * Matrix3::Identity();
  exact.bottomRightCorner<3, 3>() = turn * inertia * turn.transpose();
  EXPECT_LT((mass_matrix(robot, robot.object_body(0)) - exact).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(RobotModel, GeomsStayWhereTheModelHasThemWhateverTheMesh) {
  const ScratchFolder folder;
  // Its frame is that of MuJoCo's own mass.
  const TaskSpec task = written_task(folder, mjcf(kPadBody + R"(<body name="cup"><freejoint/>
      <geom name="cup" type="box" size="0.1 0.2 0.3" pos="0.5 0 0"/><site name="s" pos="0.5 0 0"/></body>)"),
                                     kPadLooksDown + cup() + kOneStep);
  const RobotModel robot(task, {{make_box({-0.1, -0.1, -0.1}, {0.3, 0.1, 0.1}), 0.06}}, false);
  EXPECT_EQ(robot.data().geom_xpos[3 * robot.id(mjOBJ_GEOM, "cup")], 0.5);
  EXPECT_EQ(robot.data().site_xpos[3 * robot.id(mjOBJ_SITE, "s")], 0.5);
}

TEST(RobotModel, AFreeBodyTurnsAboutTheCentreOfItsMesh) {
  const ScratchFolder folder;
  const TaskSpec task =
      written_task(folder, mjcf(kPadBody + free_body("pos=\"3 0 0\"")), kPadLooksDown + cup() + kOneStep);
  const Vector3 center(0.01, 0.0, 0.0);
  RobotModel robot(task, {{make_box(center - Vector3(0.01, 0.01, 0.01), center + Vector3(0.01, 0.01, 0.01)), 0.06}},
                   false);
  // Falls without turning: gravity acts at the centre.
  for (int n = 0; n < 100; ++n) mj_step(&robot.model(), &robot.data());
  mj_forward(&robot.model(), &robot.data());
  const Twist twist = robot.body_twist(robot.object_body(0));
  EXPECT_LT(twist.spin_rad_s.norm(), 1e-12);
  EXPECT_NEAR(twist.velocity_m_s.z(), -9.81 * 0.1, 1e-9);
}

TEST(RobotModel, PutsObjectsWhereTheTaskSays) {
  const ScratchFolder folder;
  const TaskSpec task =
      written_task(folder,
                   mjcf(kPadBody + free_body("pos=\"3 0 0\"") +
                            R"(<body name="table" pos="9 9 9"><geom type="box" size="1 1 1"/></body>)",
                        "<keyframe><key qpos=\"-0.25 5 5 5 1 0 0 0\"/></keyframe>"),
                   kPadLooksDown +
                       "objects:\n  - {name: cup, mesh: c, mass_g: 60, at_mm: [10, 20, 30], turn_deg: [0, 90, 0]}\n"
                       "  - {name: table, kind: fixed, mesh: c, at_mm: [1, 2, 3], turn_deg: [0, 0, -90]}\n" +
                       kOneStep);
  const TriangleMesh box = make_box(-Vector3::Ones(), Vector3::Ones());
  const RobotModel robot(task, {{box, 0.06}, {box, 0.0}}, false);
  Matrix4 exact;
  exact << 0, 0, 1, 0.01, 0, 1, 0, 0.02, -1, 0, 0, 0.03, 0, 0, 0, 1;
  EXPECT_LT((robot.body_pose(robot.object_body(0)) - exact).cwiseAbs().maxCoeff(), 1e-15);
  exact << 0, 1, 0, 0.001, -1, 0, 0, 0.002, 0, 0, 1, 0.003, 0, 0, 0, 1;
  EXPECT_LT((robot.body_pose(robot.object_body(1)) - exact).cwiseAbs().maxCoeff(), 1e-15);
  // The robot is as the keyframe has it.
  EXPECT_EQ(robot.data().qpos[0], -0.25);
}

TEST(RobotModel, AFixedBodyWithinAnotherIsPutInTheWorld) {
  const ScratchFolder folder;
  const TaskSpec task =
      written_task(folder, mjcf(kPadBody + R"(<body pos="1 2 3" euler="0 0 90"><geom type="box" size="1 1 1"/>
                         <body name="table" pos="1 0 0"><geom type="box" size="1 1 1"/></body></body>)"),
                   kPadLooksDown + "objects: {name: table, kind: fixed, mesh: c, at_mm: [10, 20, 30]}\n" + kOneStep);
  const RobotModel robot(task, {{}}, false);
  const Matrix4 pose = robot.body_pose(robot.object_body(0));
  EXPECT_LT((pose.topRightCorner<3, 1>() - Vector3(0.01, 0.02, 0.03)).norm(), 1e-12);
}

TEST(RobotModel, WhatTheModelLacksOrHasInAnotherWayIsSaid) {
  const ScratchFolder folder;
  const TriangleMesh box = make_box(-Vector3::Ones(), Vector3::Ones());
  const auto message = [&]<typename Error>(const std::string& model, const std::string& text) {
    const TaskSpec task = written_task(folder, model, text + kOneStep);
    return message_of<Error>([&] { RobotModel(task, {{box, 0.06}}, false); });
  };
  const std::string file = (folder / "robot.xml").string();
  const auto usage = [&](const std::string& model, const std::string& text) {
    return message.operator()<UsageError>(model, text);
  };
  EXPECT_EQ(usage(mjcf(kPadBody + free_body()), "pads: {name: gel, geom: pod}\n" + cup()),
            file + ": has no geom 'pod'; it has pad, cup");
  EXPECT_EQ(usage(mjcf(kPadBody + free_body()), kPadLooksDown + "objects: {name: mug, mesh: c, mass_g: 60}\n"),
            file + ": has no body 'mug'; it has world, weight, cup");
  EXPECT_EQ(usage(mjcf(kPadBody), kPadLooksDown + "objects: {name: weight, mesh: c, mass_g: 60}\n"),
            file + ": body weight is to be rigid, so it needs a joint of type free");
  EXPECT_EQ(usage(mjcf(kPadBody + free_body()), kPadLooksDown + "objects: {name: cup, kind: fixed, mesh: c}\n"),
            file + ": body cup is to be fixed to the world");
  EXPECT_THAT(usage(mjcf(kPadBody + free_body(), "", R"(integrator="RK4")"), kPadLooksDown + cup()),
              HasSubstr("integrator RK4 does not let forces in between its stages"));
  EXPECT_EQ(
      usage(mjcf(R"(<body name="weight"><joint name="z" type="slide"/><geom name="pad" type="mesh" mesh="t"/></body>)" +
                     free_body(),
                 R"(<asset><mesh name="t" vertex="0 0 0 1 0 0 0 1 0 0 0 1"/></asset>)"),
            kPadLooksDown + cup()),
      "pad gel: geom pad is a mesh, whose frame MuJoCo moves to its centre and principal axes; take a box or a "
      "cylinder");
  EXPECT_THAT(message.operator()<DataError>("<mujoco><worldbody><geom size=\"x\"/></worldbody></mujoco>",
                                            kPadLooksDown + cup()),
              testing::StartsWith(file + ": "));
}

TEST(RobotModel, AnErrorInsideMuJoCoIsThrown) {
  const ScratchFolder folder;
  const TaskSpec task = written_task(folder, mjcf(kPadBody + free_body()), kPadLooksDown + cup() + kOneStep);
  RobotModel robot(task, {{make_box({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}), 0.06}}, false);
  robot.data().nstack = 1;
  EXPECT_THAT(message_of<SolverError>([&] { mj_step(&robot.model(), &robot.data()); }),
              HasSubstr("MuJoCo: Stack overflow"));
}

TEST(RobotModel, PoseOfAPadIsThatOfItsGeomAndMount) {
  const ScratchFolder folder;
  const TaskSpec task =
      written_task(folder,
                   mjcf(free_body("pos=\"1 2 3\"") +
                        R"(<body name="hand" pos="0.1 0.2 0.3" euler="0 0 90"><joint type="hinge" axis="0 0 1"/>
           <geom name="pad" type="box" size="0.01 0.01 0.01" pos="0.05 0 0" euler="0 90 0" mass="1"/></body>)"),
                   "pads: {name: gel, geom: pad, at_mm: [0, 0, 10], turn_deg: [0, 0, 90]}\n" + cup() + kOneStep);
  const RobotModel robot(task, {{make_box(-Vector3::Ones(), Vector3::Ones()), 0.06}}, true);
  // The geom's z is the body's x, which is y of the world; S is turned about it, so its x is the geom's y.
  Matrix4 exact;
  exact << -1, 0, 0, 0.1, 0, 0, 1, 0.2 + 0.05 + 0.01, 0, 1, 0, 0.3, 0, 0, 0, 1;
  EXPECT_LT((robot.pad_pose(0) - exact).cwiseAbs().maxCoeff(), 1e-12) << robot.pad_pose(0);
}

TEST(RobotModel, PadUnderARestingBodyFeelsItsWeight) {
  const ScratchFolder folder;
  // The pad looks up from a fixed stand; the box of the body lies on it, off its middle.
  const TaskSpec task = written_task(
      folder,
      mjcf(R"(<body name="stand" pos="0 0 0.1"><joint type="slide" axis="1 0 0" range="0 0.0001" limited="true"/>
                <geom name="pad" type="box" size="0.5 0.5 0.02" mass="100"/></body>
              <body name="cup" pos="0.02 0.03 0.42"><freejoint/>
                <geom name="cup" type="box" size="0.1 0.2 0.3"/></body>)"),
      "pads: {name: gel, geom: pad, at_mm: [0, 0, 20]}\n" + cup() + kOneStep);
  const Vector3 half(0.1, 0.2, 0.3);
  RobotModel robot(task, {{make_box(-half, half), 0.06}}, false);
  for (int n = 0; n < 2000; ++n) mj_step(&robot.model(), &robot.data());
  mj_forward(&robot.model(), &robot.data());
  const Wrench felt = robot.pad_contact(0);
  const double weight = 0.06 * 9.81;
  EXPECT_LT((felt.force_n - Vector3(0, 0, -weight)).norm(), 1e-6);
  const Vector3 arm = (robot.body_pose(robot.object_body(0)) - robot.pad_pose(0)).topRightCorner<3, 1>();
  EXPECT_LT((felt.torque_n_m - arm.cross(Vector3(0, 0, -weight))).norm(), 1e-6);
  EXPECT_NEAR(felt.torque_n_m.x(), -0.03 * weight, 1e-3 * weight);
}

TEST(RobotModel, CoupledItsPadsAndObjectsTouchNothing) {
  const ScratchFolder folder;
  const TaskSpec task = written_task(
      folder, mjcf(R"(<geom name="floor" type="plane" size="1 1 1"/>)" + kPadBody + free_body("pos=\"0 0 0.9\"")),
      kPadLooksDown + cup() + kOneStep);
  const TriangleMesh box = make_box(-Vector3::Ones(), Vector3::Ones());
  const RobotModel alone(task, {{box, 0.06}}, false), coupled(task, {{box, 0.06}}, true);
  EXPECT_GT(alone.data().ncon, 0);
  EXPECT_EQ(coupled.data().ncon, 0);
}

TEST(RobotModel, CoupledAPairThatWouldTouchAllTheSameIsRefused) {
  const ScratchFolder folder;
  const TaskSpec task =
      written_task(folder, mjcf(kPadBody + free_body(), R"(<contact><pair geom1="pad" geom2="cup"/></contact>)"),
                   kPadLooksDown + cup() + kOneStep);
  const TriangleMesh box = make_box(-Vector3::Ones(), Vector3::Ones());
  EXPECT_NO_THROW(RobotModel(task, {{box, 0.06}}, false));
  EXPECT_THAT(message_of<UsageError>([&] { RobotModel(task, {{box, 0.06}}, true); }), HasSubstr("contact pair of "));
}

TEST(RobotModel, CoupledAnObjectStaysWhereItIsPut) {
  const ScratchFolder folder;
  const TaskSpec task = written_task(folder, mjcf(kPadBody + free_body()), kPadLooksDown + cup() + kOneStep);
  RobotModel robot(task, {{make_box(-Vector3::Ones(), Vector3::Ones()), 0.06}}, true);
  const Matrix4 before = robot.body_pose(robot.object_body(0));
  for (int n = 0; n < 10; ++n) {
    mj_step1(&robot.model(), &robot.data());
    robot.forget_pushes();
    mj_step2(&robot.model(), &robot.data());
  }
  mj_kinematics(&robot.model(), &robot.data());
  // Free it would have fallen by half a millimetre.
  EXPECT_LT((robot.body_pose(robot.object_body(0)) - before).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(RobotModel, PushOnAPadIsWhatMuJoCosOwnFunctionMakesOfIt) {
  const ScratchFolder folder;
  const TaskSpec task = written_task(
      folder,
      mjcf(free_body("pos=\"1 2 3\"") +
           R"(<body name="arm" euler="10 20 30"><joint type="hinge" axis="0 0 1"/><joint type="hinge" axis="0 1 0"/>
             <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02"/>
             <body pos="0.3 0 0" euler="0 40 0"><joint type="slide" axis="1 0 0"/><joint type="hinge" axis="1 0 1"/>
               <geom type="box" size="0.1 0.02 0.03" pos="0.1 0.01 0"/>
               <geom name="pad" type="box" size="0.01 0.01 0.01" pos="0.2 0 0.05" euler="0 90 0"/></body></body>)"),
      "pads: {name: gel, geom: pad, at_mm: [1, 2, 10], turn_deg: [0, 30, 90]}\n" + cup() + kOneStep);
  RobotModel robot(task, {{make_box(-Vector3::Ones(), Vector3::Ones()), 0.06}}, true);
  const mjModel& m = robot.model();
  mjData& d = robot.data();
  const int body = robot.model().geom_bodyid[robot.id(mjOBJ_GEOM, "pad")];
  const Wrench wrench{{1.0, -2.0, 3.0}, {0.1, 0.2, -0.3}};
  const Vector3 origin = robot.pad_pose(0).topRightCorner<3, 1>();
  Eigen::VectorXd exact = Eigen::VectorXd::Zero(m.nv), got = Eigen::VectorXd::Zero(m.nv);
  mj_applyFT(&m, &d, wrench.force_n.data(), wrench.torque_n_m.data(), origin.data(), body, exact.data());
  robot.push_pad(0, {{5, 6, 7}, {8, 9, 1}});
  robot.forget_pushes();
  robot.push_pad(0, wrench);
  mj_applyFT(&m, &d, d.xfrc_applied + 6 * body, d.xfrc_applied + 6 * body + 3, d.xipos + 3 * body, body, got.data());
  EXPECT_GT(exact.norm(), 1.0);
  EXPECT_LT((got - exact).norm(), 1e-12);
  // It is what accelerates the robot.
  Eigen::VectorXd without(m.nv), moved(m.nv);
  robot.forget_pushes();
  mj_forward(&m, &d);
  without = Eigen::Map<Eigen::VectorXd>(d.qfrc_inverse, m.nv);
  mj_inverse(&m, &d);
  const Eigen::VectorXd before = Eigen::Map<Eigen::VectorXd>(d.qfrc_inverse, m.nv);
  robot.push_pad(0, wrench);
  mj_forward(&m, &d);
  robot.forget_pushes();
  mj_inverse(&m, &d);
  EXPECT_LT((Eigen::Map<Eigen::VectorXd>(d.qfrc_inverse, m.nv) - before - exact).norm(), 1e-9);
}

TEST(RobotModel, AnObjectIsPutAtRest) {
  const ScratchFolder folder;
  const TaskSpec task = written_task(folder, mjcf(kPadBody + free_body()), kPadLooksDown + cup() + kOneStep);
  RobotModel robot(task, {{make_box(-Vector3::Ones(), Vector3::Ones()), 0.06}}, true);
  for (int n = 0; n < 10; ++n) mj_step(&robot.model(), &robot.data());
  Matrix4 pose = Matrix4::Identity();
  pose.topLeftCorner<3, 3>() = Eigen::AngleAxisd(3.0, Vector3(1, -2, 0.5).normalized()).toRotationMatrix();
  pose.topRightCorner<3, 1>() = Vector3(1, 2, 3);
  robot.put_object(0, pose);
  mj_forward(&robot.model(), &robot.data());
  EXPECT_LT((robot.body_pose(robot.object_body(0)) - pose).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_EQ(robot.body_twist(robot.object_body(0)).velocity_m_s, Vector3::Zero());
}

TEST(RobotModel, TwistIsThatOfTheFramesOriginAlongTheWorld) {
  const ScratchFolder folder;
  const TaskSpec task = written_task(folder, mjcf(kPadBody + R"(<body name="cup" pos="0 0 2" euler="90 0 0"><freejoint/>
      <geom type="box" size="0.1 0.2 0.3" pos="0.4 0 0" mass="7"/></body>)"),
                                     kPadLooksDown + cup() + kOneStep);
  RobotModel robot(task, {{make_box({-0.1, -0.1, -0.1}, {0.3, 0.1, 0.1}), 0.06}}, false);
  const int at = robot.model().jnt_dofadr[robot.model().body_jntadr[robot.object_body(0)]];
  const double velocity[6] = {1, 2, 3, 4, 5, 6};
  std::copy_n(velocity, 6, robot.data().qvel + at);
  mj_forward(&robot.model(), &robot.data());
  const Twist twist = robot.body_twist(robot.object_body(0));
  EXPECT_LT((twist.velocity_m_s - Vector3(1, 2, 3)).norm(), 1e-12);
  // MuJoCo's spin of a free joint is along the body's axes: its y is z of the world, its z is −y.
  EXPECT_LT((twist.spin_rad_s - Vector3(4, -6, 5)).norm(), 1e-12);
}

TEST(Quaternions, GoThereAndBack) {
  for (int n = 0; n < 200; ++n) {
    const Vector3 axis = Vector3(std::sin(1.0 + n), std::cos(3.0 * n), std::sin(2.0 * n)).normalized();
    const Matrix3 rotation = Eigen::AngleAxisd(2.0 * std::numbers::pi * n / 199.0, axis).toRotationMatrix();
    mjtNum wxyz[4], matrix[9];
    to_wxyz(rotation, wxyz);
    EXPECT_LT((quaternion_from(wxyz).toRotationMatrix() - rotation).cwiseAbs().maxCoeff(), 1e-14);
    // MuJoCo takes it for the same.
    mju_quat2Mat(matrix, wxyz);
    const mjtNum origin[3] = {1, 2, 3};
    const Matrix4 pose = pose_from(origin, matrix);
    EXPECT_LT((pose.topLeftCorner<3, 3>() - rotation).cwiseAbs().maxCoeff(), 1e-14);
    EXPECT_EQ(Vector3(pose.topRightCorner<3, 1>()), Vector3(1, 2, 3));
  }
}

}  // namespace mjcf_model_test
}  // namespace tacipc
