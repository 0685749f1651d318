#include "common/sample/robot_folder.h"

#include <cctype>

#include "common/sample/press_folder.h"
#include "common/stage/record.h"

namespace tacipc {
namespace {

namespace fs = std::filesystem;
using enum NpyType;

constexpr std::string_view kModelBodies = "model bodies", kActuators = "actuators", kPositions = "nq",
                           kVelocities = "nv";

const std::array<NpyField, 13>& all_fields() {
  static const std::array<NpyField, 13> kFields{{
      field_of(PressArray::time),
      {"step.npy", i4, {kFrames}, "", "step of the task, from 0"},
      {"qpos.npy", f8, {kFrames, kPositions}, "m, rad", "MuJoCo's own positions; quaternions are w, x, y, z"},
      {"qvel.npy", f8, {kFrames, kVelocities}, "m/s, rad/s", "MuJoCo's own velocities"},
      {"control.npy", f8, {kFrames, kActuators}, "", "commands of the actuators in the time step before"},
      {"actuator_force.npy", f8, {kFrames, kActuators}, "N, N m", "forces of the actuators in the time step before"},
      {"model_pose.npy",
       f8,
       {kFrames, kModelBodies, 4, 4},
       "m",
       "`world_from_body` of all bodies of the model but the world. Of a coupled run's rigid objects take pose and "
       "twist from the scene's arrays: here they are put, at rest, where an earlier try had them"},
      {"model_twist.npy",
       f8,
       {kFrames, kModelBodies, 6},
       "m/s, rad/s",
       "velocity of the origin of its frame, angular velocity, axes of the world"},
      {"pad_pose.npy", f8, {kFrames, kPads, 4, 4}, "m", "`world_from_gel`"},
      {"pad_wrench.npy",
       f8,
       {kFrames, kPads, 6},
       "N, N m",
       "on each pad as the robot felt it, force and torque about the origin of its S, axes of the world"},
      {"paths/<pad>.npy", f8, {kFrames, 4, 4}, "m", "path of a gel, for `scene.yaml`: its poses in `pad_pose.npy`"},
      {"state.npy", f8, {kStateNumbers}, "", "state of MuJoCo's model, from which a next window goes on"},
      {"answers.npy",
       f8,
       {kWindowFrames, kPads, kAnswerNumbers},
       "m, N, N m",
       "of a window's try: pose of each pad (16 numbers), wrench (6) and gap (1) that the press returned for the try "
       "before"},
  }};
  return kFields;
}

/// Calls visit(array, member) for each array that has a row of items per frame.
template <typename Visit>
void each_row(Visit&& visit) {
  visit(RobotArray::qpos, &RobotFrame::qpos);
  visit(RobotArray::qvel, &RobotFrame::qvel);
  visit(RobotArray::control, &RobotFrame::control);
  visit(RobotArray::actuator_force, &RobotFrame::actuator_force);
  visit(RobotArray::model_pose, &RobotFrame::body_pose);
  visit(RobotArray::model_twist, &RobotFrame::body_twist);
  visit(RobotArray::pad_pose, &RobotFrame::pad_pose);
  visit(RobotArray::pad_wrench, &RobotFrame::pad_wrench);
}

}  // namespace

std::span<const NpyField> robot_fields() { return all_fields(); }

const NpyField& field_of(RobotArray array) { return all_fields()[static_cast<std::size_t>(array)]; }

void write_robot_folder(Stage& stage, const RobotFolder& robot) {
  const std::vector<RobotFrame>& frames = robot.frames;
  const ArrayWriter writer(stage, {{kFrames, frames.size()},
                                   {kModelBodies, robot.parts.bodies.size()},
                                   {kPads, robot.parts.pads.size()},
                                   {kActuators, robot.parts.actuators.size()},
                                   {kPositions, frames[0].qpos.size()},
                                   {kVelocities, frames[0].qvel.size()}});
  writer.write(RobotArray::time, frames, &RobotFrame::time_s);
  writer.write(RobotArray::step, frames, &RobotFrame::step);
  each_row([&](RobotArray array, auto member) { writer.write(array, frames, member); });
}

Value::Map robot_summary(const RobotFolder& robot) {
  const auto list = [](const std::vector<std::string>& names) { return Value::List(names.begin(), names.end()); };
  return {{"frames", robot.frames.size()},
          {"bodies", list(robot.parts.bodies)},
          {"pads", list(robot.parts.pads)},
          {"actuators", list(robot.parts.actuators)}};
}

RobotFolder read_robot_folder(const fs::path& folder) {
  ArrayFolder arrays = ArrayFolder::finished(folder, "robot");
  const Record summary = arrays.summary();
  RobotFolder robot{.parts = {summary.texts("bodies"), summary.texts("pads"), summary.texts("actuators")},
                    .frames = {}};
  arrays.know({{kModelBodies, robot.parts.bodies.size()},
               {kPads, robot.parts.pads.size()},
               {kActuators, robot.parts.actuators.size()}});
  const std::vector<double> times = arrays.whole(field_of(RobotArray::time)),
                            steps = arrays.whole(field_of(RobotArray::step));
  for (std::size_t f = 0; f < times.size(); ++f) {
    RobotFrame& frame = robot.frames.emplace_back();
    frame.time_s = times[f];
    frame.step = static_cast<int>(steps[f]);
  }
  each_row([&]<typename Item>(RobotArray array, std::vector<Item> RobotFrame::*member) {
    const std::vector<Item> all = arrays.items<Item>(field_of(array));
    auto at = all.begin();
    const auto of_frame = static_cast<std::ptrdiff_t>(all.size() / times.size());
    for (RobotFrame& frame : robot.frames) {
      (frame.*member).assign(at, at + of_frame);
      at += of_frame;
    }
  });
  return robot;
}

fs::path robot_shape(const fs::path& folder, const std::string& body) {
  // A model's names may contain characters that file names may not.
  std::string name = body;
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_' && c != '-') c = '_';
  }
  return folder / "shapes" / (name + ".ply");
}

}  // namespace tacipc
