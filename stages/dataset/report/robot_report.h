// What the folder of a robot's run tells beside its arrays: the task, what was drawn for it, how robot and press came
// to agree.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/sample/robot_folder.h"
#include "common/sample/scene_hold.h"

namespace tacipc {

/// One try of a window, in which the robot felt what the press had answered to the try before.
struct CouplingTry {
  int window = 0, frames = 0;  // its number from 1, and how many frames it has
  int number = 0;              // of the try, from 1
  double residual_n = 0.0, residual_relative = 0.0, stiffness_n_m = 0.0;
  std::optional<double> apart_m = {};  // of gels and robot, where that felt the answer as it is

  bool of_one_window(const CouplingTry& other) const { return window == other.window && frames == other.frames; }
};

struct RobotReport {
  std::string task, seed;
  std::vector<std::pair<std::string, double>> variables;  // that were drawn
  std::vector<std::string> steps;                         // of the task, "1 grip", "2 move", …
  RobotFolder motion;
  std::vector<CouplingTry>
      tries;                // in the order in which they were made; none of a robot that felt MuJoCo's own contacts
  double tolerance = 1e-3;  // of residual_relative
  std::vector<HeldBodyLines> held = {};  // by the gels, as the record of the scene has them
};

/// Folder of a robot below that of its scene.
std::filesystem::path robot_folder(const std::filesystem::path& scene);

/// Nothing where the scene has no robot. \throw DataError for what is malformed
std::optional<RobotReport> read_robot_report(const std::filesystem::path& scene);

}  // namespace tacipc
