// Reads a robot's run from its folder, except the arrays: the task, its drawn variables, and the coupling iterations of
// robot and press.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/sample/press_record.h"
#include "common/sample/robot_folder.h"

namespace tacipc {

/// One coupling iteration ("try") of a time window. Its loads on the robot are the response of the press in the
/// previous one.
struct CouplingTry {
  int window = 0, frames = 0;  // number of the window from 1, and its frames
  int number = 0;              // number of the iteration, from 1
  double residual_n = 0.0, residual_relative = 0.0, stiffness_n_m = 0.0;
  std::optional<double> apart_m =
      {};  // distance between gels and robot, if the robot was loaded by the response itself

  bool of_one_window(const CouplingTry& other) const { return window == other.window && frames == other.frames; }
};

/// Data of a robot's run.
struct RobotReport {
  std::string task, seed;
  std::vector<std::pair<std::string, double>> variables;  // names and values of the drawn variables
  std::vector<std::string> steps;                         // steps of the task: "1 grip", "2 move", …
  RobotFolder motion;
  std::vector<CouplingTry> tries;  // all iterations in order of execution; empty for a robot with MuJoCo's own contacts
  double tolerance = 1e-3;         // tolerance of residual_relative
  std::vector<HeldBodyLines> held = {};  // bodies held by the gels, as in the record of the scene
};

/// Folder of the robot, below that of its scene.
std::filesystem::path robot_folder(const std::filesystem::path& scene);

/// Reads the report; nothing if the scene has no robot.
/// \throw DataError for malformed content
std::optional<RobotReport> read_robot_report(const std::filesystem::path& scene);

}  // namespace tacipc
