#include "common/sample/robot_folder.h"

#include <cctype>

#include "common/base/error.h"
#include "common/format/npy_field.h"
#include "common/format/npy_pose.h"
#include "common/stage/record.h"

namespace tacipc {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kBodies = "bodies", kPads = "pads", kActuators = "actuators", kPositions = "positions",
                           kVelocities = "velocities";

const NpyField kTimes{.file = "time.npy", .shape = {kFrames}, .unit = "s"};
const NpyField kSteps{.file = "step.npy", .type = NpyType::i4, .shape = {kFrames}};
const NpyField kQpos{.file = "qpos.npy", .shape = {kFrames, kPositions}, .unit = "m, rad"};
const NpyField kQvel{.file = "qvel.npy", .shape = {kFrames, kVelocities}, .unit = "m/s, rad/s"};
const NpyField kControl{.file = "control.npy", .shape = {kFrames, kActuators}};
const NpyField kActuatorForce{.file = "actuator_force.npy", .shape = {kFrames, kActuators}, .unit = "N, N m"};
const NpyField kBodyPose{.file = "body_pose.npy", .shape = {kFrames, kBodies, 4, 4}, .unit = "m"};
const NpyField kBodyTwist{.file = "body_twist.npy", .shape = {kFrames, kBodies, 6}, .unit = "m/s, rad/s"};
const NpyField kPadPose{.file = "pad_pose.npy", .shape = {kFrames, kPads, 4, 4}, .unit = "m"};
const NpyField kPadWrench{.file = "pad_wrench.npy", .shape = {kFrames, kPads, 6}, .unit = "N, N m"};

void add(std::vector<double>& all, double number) { all.push_back(number); }
void add(std::vector<double>& all, const Matrix4& pose) { append_pose(all, pose); }
void add(std::vector<double>& all, const Vector3& v) { all.insert(all.end(), v.begin(), v.end()); }
void add(std::vector<double>& all, const Twist& twist) { add(all, twist.velocity_m_s), add(all, twist.spin_rad_s); }
void add(std::vector<double>& all, const Wrench& wrench) { add(all, wrench.force_n), add(all, wrench.torque_n_m); }

void take(const double*& at, double& number) { number = *at++; }
void take(const double*& at, Matrix4& pose) { pose = pose_of(at), at += 16; }
void take(const double*& at, Vector3& v) { v = {at[0], at[1], at[2]}, at += 3; }
void take(const double*& at, Twist& twist) { take(at, twist.velocity_m_s), take(at, twist.spin_rad_s); }
void take(const double*& at, Wrench& wrench) { take(at, wrench.force_n), take(at, wrench.torque_n_m); }

/// Calls visit(field, member) for each array that has a row of things per frame.
template <typename Visit>
void each_row(Visit&& visit) {
  visit(kQpos, &RobotFrame::qpos);
  visit(kQvel, &RobotFrame::qvel);
  visit(kControl, &RobotFrame::control);
  visit(kActuatorForce, &RobotFrame::actuator_force);
  visit(kBodyPose, &RobotFrame::body_pose);
  visit(kBodyTwist, &RobotFrame::body_twist);
  visit(kPadPose, &RobotFrame::pad_pose);
  visit(kPadWrench, &RobotFrame::pad_wrench);
}

}  // namespace

void write_robot_folder(Stage& stage, const RobotFolder& robot) {
  const std::vector<RobotFrame>& frames = robot.frames;
  const Extents known{{kFrames, frames.size()},
                      {kBodies, robot.parts.bodies.size()},
                      {kPads, robot.parts.pads.size()},
                      {kActuators, robot.parts.actuators.size()},
                      {kPositions, frames[0].qpos.size()},
                      {kVelocities, frames[0].qvel.size()}};
  const auto write = [&](const NpyField& field, const std::vector<double>& values) {
    write_field(field, stage.output(field.file), known, values);
  };
  std::vector<double> times, steps;
  for (const RobotFrame& frame : frames) {
    times.push_back(frame.time_s);
    steps.push_back(frame.step);
  }
  write(kTimes, times);
  write(kSteps, steps);
  each_row([&](const NpyField& field, auto member) {
    std::vector<double> values;
    for (const RobotFrame& frame : frames) {
      for (const auto& item : frame.*member) add(values, item);
    }
    write(field, values);
  });
}

Value::Map robot_summary(const RobotFolder& robot) {
  const auto list = [](const std::vector<std::string>& names) { return Value::List(names.begin(), names.end()); };
  return {{"frames", robot.frames.size()},
          {"bodies", list(robot.parts.bodies)},
          {"pads", list(robot.parts.pads)},
          {"actuators", list(robot.parts.actuators)}};
}

RobotFolder read_robot_folder(const fs::path& folder) {
  if (!fs::is_regular_file(folder / "robot.yaml"))
    throw DataError("{}: has no robot.yaml, so the robot did not finish", folder.string());
  const Record summary = Record::from_file(folder / "robot.yaml").section("summary");
  RobotFolder robot{.parts = {summary.texts("bodies"), summary.texts("pads"), summary.texts("actuators")},
                    .frames = {}};
  Extents known{{kBodies, robot.parts.bodies.size()},
                {kPads, robot.parts.pads.size()},
                {kActuators, robot.parts.actuators.size()}};
  const auto read = [&](const NpyField& field) { return read_field(field, folder / field.file, known).data; };
  const std::vector<double> times = read(kTimes), steps = read(kSteps);
  if (times.empty()) throw DataError("{}: has no frames", (folder / kTimes.file).string());
  for (std::size_t f = 0; f < times.size(); ++f) {
    RobotFrame& frame = robot.frames.emplace_back();
    frame.time_s = times[f];
    frame.step = static_cast<int>(steps[f]);
  }
  each_row([&](const NpyField& field, auto member) {
    const std::vector<double> values = read(field);
    const std::size_t items = known.at(std::get<std::string_view>(field.shape[1]));
    const double* at = values.data();
    for (RobotFrame& frame : robot.frames) {
      (frame.*member).resize(items);
      for (auto& item : frame.*member) take(at, item);
    }
  });
  return robot;
}

fs::path robot_shape(const fs::path& folder, const std::string& body) {
  // A name of a model may hold what a file's may not.
  std::string name = body;
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_' && c != '-') c = '_';
  }
  return folder / "shapes" / (name + ".ply");
}

}  // namespace tacipc
