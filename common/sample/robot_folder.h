// A folder that `robot` wrote: the motion of a robot frame by frame. The only place that knows its arrays.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/types.h"
#include "common/base/wrench.h"
#include "common/sample/array_folder.h"

namespace tacipc {

enum class RobotArray {
  time,
  step,
  qpos,
  qvel,
  control,
  actuator_force,
  model_pose,
  model_twist,
  pad_pose,
  pad_wrench,
  path,
  state,
  answers
};

/// Symbols of shapes.
inline constexpr std::string_view kPads = "pads", kWindowFrames = "window frames", kStateNumbers = "#state";
/// Numbers of a pad's answer: pose, wrench, gap.
inline constexpr int kAnswerNumbers = 16 + 6 + 1;

/// Every array, in the order of the enum: the table that docs/files.md shows.
std::span<const NpyField> robot_fields();
const NpyField& field_of(RobotArray array);

/// What a robot is made of, in the order of the arrays.
struct RobotParts {
  std::vector<std::string> bodies, pads, actuators;
};

/// One instant, in the world.
struct RobotFrame {
  double time_s = 0.0;
  int step = 0;  // of the task
  std::vector<double> qpos, qvel, control, actuator_force;
  std::vector<Matrix4> body_pose;  // world_from_body of all bodies of the model but the world, m
  std::vector<Twist> body_twist;   // of the origins of their frames
  std::vector<Matrix4> pad_pose;   // world_from_gel, m
  std::vector<Wrench> pad_wrench;  // as the robot felt it: on the pad, about the origin of its S
};

struct RobotFolder {
  RobotParts parts;
  std::vector<RobotFrame> frames;
};

/// Writes the arrays of the frames as outputs of a stage; names of the parts go into the record's summary, which the
/// caller writes.
void write_robot_folder(Stage& stage, const RobotFolder& robot);

/// \throw DataError if the robot did not finish, or an array is missing or of another shape
RobotFolder read_robot_folder(const std::filesystem::path& folder);

/// The file with the shapes of a body in its own frame, in m; bodies without any have none.
std::filesystem::path robot_shape(const std::filesystem::path& folder, const std::string& body);

/// Lines of the summary of the record that read_robot_folder needs.
Value::Map robot_summary(const RobotFolder& robot);

}  // namespace tacipc
