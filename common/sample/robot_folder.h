// The folder that `robot` writes: motion of a robot, frame by frame. The only unit that declares its arrays.
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

/// Arrays of a robot folder; field_of() gives file, shape, unit and meaning.
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

/// Symbols in array shapes.
inline constexpr std::string_view kPads = "pads", kWindowFrames = "window frames", kStateNumbers = "#state";
/// Number of values that store a pad's response: pose, wrench, gap.
inline constexpr int kAnswerNumbers = 16 + 6 + 1;

/// Returns the declarations of all arrays in the order of the enum: the table of docs/files.md.
std::span<const NpyField> robot_fields();
/// Returns the declaration of an array.
const NpyField& field_of(RobotArray array);

/// Names of the parts of a robot, in the order of the arrays.
struct RobotParts {
  std::vector<std::string> bodies, pads, actuators;
};

/// State at one instant, in the world.
struct RobotFrame {
  double time_s = 0.0;
  int step = 0;  // index of the task's step
  std::vector<double> qpos, qvel, control, actuator_force;
  std::vector<Matrix4> body_pose;  // world_from_body, m, of all bodies of the model but the world
  std::vector<Twist> body_twist;   // velocities of the bodies' origins, and spins
  std::vector<Matrix4> pad_pose;   // world_from_gel, m
  std::vector<Wrench> pad_wrench;  // wrench that the robot applied to the pad, about the origin of its S
};

/// Contents of the folder.
struct RobotFolder {
  RobotParts parts;
  std::vector<RobotFrame> frames;
};

/// Writes the arrays of the frames as outputs of a stage. Names of the parts belong to the record's summary, which the
/// caller writes; see robot_summary().
void write_robot_folder(Stage& stage, const RobotFolder& robot);

/// Reads the folder.
/// \throw DataError if the robot run did not finish, or an array is missing or has another shape
RobotFolder read_robot_folder(const std::filesystem::path& folder);

/// Returns the path of the file with a body's shapes, in the body's frame, m. Bodies without shapes have no file.
std::filesystem::path robot_shape(const std::filesystem::path& folder, const std::string& body);

/// Returns the entries of the record's summary that read_robot_folder() needs.
Value::Map robot_summary(const RobotFolder& robot);

}  // namespace tacipc
