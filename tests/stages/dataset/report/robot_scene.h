// The scene of pressed_cube.h with a robot that carries its gel: two frames, the second in contact.
#pragma once

#include <array>

#include "common/sample/robot_folder.h"
#include "tests/stages/gel/export/pressed_cube.h"

namespace tacipc {

constexpr const char* kRobotRecord = R"(stage: robot
task:
  model: robot.xml
  steps:
    - {seconds: 0.01, set: {grip: 0.01}}
    - {seconds: 0.01, move: {site: hand, by_mm: [0, 0, 10]}}
  coupling: {tolerance: 0.002}
variables: {mass_g: 50}
name: pick
seed: 7
summary: {bodies: [arm, peg], pads: [pad], actuators: [grip, idle]}
)";

/// Of a second window that was halved: a folder named 2 is listed before 5; and of a third that was accepted for the
/// robot's place.
constexpr const char* kResiduals =
    "window,frames,first_frame,try,residual_n,residual_relative,stiffness_n_m,apart_m\n"
    "0001,5,0,1,0,0,30000,\n0002,2,5,1,0.1,0.05,42000,\n0002,2,5,2,0.002,0.0015,43000,\n"
    "0002,5,5,1,2,0.5,40000,\n0002,5,5,2,1,0.25,41000,1e-4\n"
    "0003,5,7,1,1,0.3,41000,\n0003,5,7,2,0.5,0.2,41000,2.5e-6\n";

/// Folder "bodies": its robot felt 0.25 N less along x, and 2 N into the gel as the press answers.
inline void write_robot_scene(const ScratchFolder& scratch) {
  write_pressed_bodies(scratch);
  const std::filesystem::path robot = scratch.file("bodies/robot/robot.yaml", kRobotRecord).parent_path();
  scratch.file("bodies/residuals.csv", kResiduals);
  const auto write = [&](const char* name, const std::vector<std::size_t>& shape, const std::vector<double>& values) {
    write_npy(robot / name, shape, values.data());
  };
  write("time.npy", {2}, {0.0, 0.01});
  const std::array<std::int32_t, 2> steps{0, 1};
  write_npy(robot / "step.npy", {2}, steps.data());
  write("qpos.npy", {2, 1}, {0, 0});
  write("qvel.npy", {2, 1}, {0, 0});
  write("control.npy", {2, 2}, {0, 3, 0.01, 3});
  write("actuator_force.npy", {2, 2}, {0, 0, 5, 0});
  std::vector<double> bodies, pads;
  for (int frame = 0; frame < 2; ++frame) {
    for (const double z : {0.0, -0.003 * frame}) {
      Matrix4 pose = Matrix4::Identity();
      pose(2, 3) = z;
      for (int i = 0; i < 16; ++i) bodies.push_back(pose(i / 4, i % 4));
    }
    for (int i = 0; i < 16; ++i) pads.push_back(i % 5 == 0 ? 1.0 : 0.0);
  }
  write("model_pose.npy", {2, 2, 4, 4}, bodies);
  write("model_twist.npy", {2, 2, 6}, std::vector<double>(24, 0.0));
  write("pad_pose.npy", {2, 1, 4, 4}, pads);
  write("pad_wrench.npy", {2, 1, 6}, {0, 0, 0, 0, 0, 0, 0.25, 0, -2, 0, 0, 0});
  // A block around the gel's front, which reaches from its middle to behind it.
  std::filesystem::create_directories(robot / "shapes");
  const TriangleMesh arm{Positions{{0, 0, 1e-4}, {1e-2, 0, 1e-4}, {0, 1e-2, -0.02}, {0, 0, -0.02}},
                         Triangles{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}};
  write_ply(robot_shape(robot, "arm"), arm);
  write_ply(robot_shape(robot, "peg"), arm);
  write_ply(robot_shape(robot, "world"), arm);
}

}  // namespace tacipc
