#include "common/sample/robot_folder.h"

#include <cctype>

#include "common/base/error.h"
#include "common/format/npy_field.h"
#include "common/stage/record.h"

namespace tacipc {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kFrames = "frames", kBodies = "bodies", kPads = "pads", kActuators = "actuators",
                           kPositions = "positions", kVelocities = "velocities";

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

void add(std::vector<double>& all, const Matrix4& pose) {
  for (int i = 0; i < 16; ++i) all.push_back(pose(i / 4, i % 4));
}
void add(std::vector<double>& all, const Vector3& v) { all.insert(all.end(), v.begin(), v.end()); }

/// Rows of one frame each.
std::vector<std::vector<double>> rows(const std::vector<double>& values, std::size_t frames) {
  std::vector<std::vector<double>> all;
  const std::size_t each = frames > 0 ? values.size() / frames : 0;
  for (std::size_t f = 0; f < frames; ++f)
    all.emplace_back(values.begin() + static_cast<std::ptrdiff_t>(f * each),
                     values.begin() + static_cast<std::ptrdiff_t>((f + 1) * each));
  return all;
}

std::vector<std::vector<Matrix4>> poses(const std::vector<double>& values, std::size_t frames) {
  std::vector<std::vector<Matrix4>> all;
  for (const auto& row : rows(values, frames)) {
    auto& of_frame = all.emplace_back();
    for (std::size_t at = 0; at < row.size(); at += 16)
      of_frame.emplace_back(Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(row.data() + at));
  }
  return all;
}

/// Two vectors each: linear and angular.
template <typename Visit>
void pairs(const std::vector<double>& values, std::size_t frames, Visit&& visit) {
  const auto by_frame = rows(values, frames);
  for (std::size_t f = 0; f < frames; ++f) {
    for (std::size_t at = 0; at < by_frame[f].size(); at += 6) {
      const double* six = by_frame[f].data() + at;
      visit(f, Vector3(six[0], six[1], six[2]), Vector3(six[3], six[4], six[5]));
    }
  }
}

}  // namespace

void write_robot_folder(Stage& stage, const RobotFolder& robot) {
  const std::size_t frames = robot.times_s.size();
  const Extents known{{kFrames, frames},
                      {kBodies, robot.parts.bodies.size()},
                      {kPads, robot.parts.pads.size()},
                      {kActuators, robot.parts.actuators.size()},
                      {kPositions, robot.qpos[0].size()},
                      {kVelocities, robot.qvel[0].size()}};
  const auto write = [&](const NpyField& field, const std::vector<double>& values) {
    write_field(field, stage.output(field.file), known, values);
  };
  const auto joined = [&](const std::vector<std::vector<double>>& all) {
    std::vector<double> values;
    for (const auto& row : all) values.insert(values.end(), row.begin(), row.end());
    return values;
  };
  write(kTimes, robot.times_s);
  write(kSteps, {robot.step.begin(), robot.step.end()});
  write(kQpos, joined(robot.qpos));
  write(kQvel, joined(robot.qvel));
  write(kControl, joined(robot.control));
  write(kActuatorForce, joined(robot.actuator_force));
  std::vector<double> body_pose, body_twist, pad_pose, pad_wrench;
  for (std::size_t f = 0; f < frames; ++f) {
    for (const Matrix4& pose : robot.body_pose[f]) add(body_pose, pose);
    for (std::size_t b = 0; b < robot.parts.bodies.size(); ++b) {
      add(body_twist, robot.body_velocity_m_s[f][b]);
      add(body_twist, robot.body_spin_rad_s[f][b]);
    }
    for (const Matrix4& pose : robot.pad_pose[f]) add(pad_pose, pose);
    for (const Wrench& wrench : robot.pad_wrench[f]) {
      add(pad_wrench, wrench.force_n);
      add(pad_wrench, wrench.torque_n_m);
    }
  }
  write(kBodyPose, body_pose);
  write(kBodyTwist, body_twist);
  write(kPadPose, pad_pose);
  write(kPadWrench, pad_wrench);
}

Value::Map robot_summary(const RobotFolder& robot) {
  const auto list = [](const std::vector<std::string>& names) { return Value::List(names.begin(), names.end()); };
  return {{"frames", robot.times_s.size()},
          {"bodies", list(robot.parts.bodies)},
          {"pads", list(robot.parts.pads)},
          {"actuators", list(robot.parts.actuators)}};
}

RobotFolder read_robot_folder(const fs::path& folder) {
  if (!fs::is_regular_file(folder / "robot.yaml"))
    throw DataError("{}: has no robot.yaml, so the robot did not finish", folder.string());
  const Record summary = Record::from_file(folder / "robot.yaml").section("summary");
  RobotFolder robot;
  robot.parts = {summary.texts("bodies"), summary.texts("pads"), summary.texts("actuators")};
  Extents known{{kBodies, robot.parts.bodies.size()},
                {kPads, robot.parts.pads.size()},
                {kActuators, robot.parts.actuators.size()}};
  const auto read = [&](const NpyField& field) { return read_field(field, folder / field.file, known).data; };
  robot.times_s = read(kTimes);
  const std::size_t frames = robot.times_s.size();
  if (frames == 0) throw DataError("{}: has no frames", (folder / kTimes.file).string());
  for (const double step : read(kSteps)) robot.step.push_back(static_cast<int>(step));
  robot.qpos = rows(read(kQpos), frames);
  robot.qvel = rows(read(kQvel), frames);
  robot.control = rows(read(kControl), frames);
  robot.actuator_force = rows(read(kActuatorForce), frames);
  robot.body_pose = poses(read(kBodyPose), frames);
  robot.pad_pose = poses(read(kPadPose), frames);
  robot.body_velocity_m_s.resize(frames);
  robot.body_spin_rad_s.resize(frames);
  robot.pad_wrench.resize(frames);
  pairs(read(kBodyTwist), frames, [&](std::size_t f, const Vector3& velocity, const Vector3& spin) {
    robot.body_velocity_m_s[f].push_back(velocity);
    robot.body_spin_rad_s[f].push_back(spin);
  });
  pairs(read(kPadWrench), frames, [&](std::size_t f, const Vector3& force, const Vector3& torque) {
    robot.pad_wrench[f].push_back({force, torque});
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
