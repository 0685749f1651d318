// Shows a robot on a page in addition to its scene: the task, forces on its pads, its actuators, its grip on the
// object, and the convergence of the coupling of robot and press.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/sample/scene_folder.h"
#include "stages/dataset/report/robot_report.h"
#include "stages/dataset/report/timeline.h"

namespace tacipc {

/// Frames with the steps of the task as their phases.
/// \throw DataError if the robot has other frames, or its task no steps
std::vector<Instant> steps_over_time(const RobotReport& robot, std::vector<Instant> frames);

/// Force on a pad, normal (positive into it) and along its front, N.
struct PadForce {
  double normal_n = 0.0, tangential_n = 0.0;
};
/// Splits a force (N) on a gel, in world axes.
PadForce pad_force(const Matrix4& world_from_gel, const Vector3& force_n);

/// Forces of one pad, frame by frame.
struct PadForces {
  std::string pad;
  std::vector<PadForce> answered, felt;  // forces computed by the press, and forces applied to the robot
  double apart_n = 0.0;                  // largest length of their difference
};
/// Collects the forces of all pads.
/// \throw DataError if a pad is not a gel of the scene
std::vector<PadForces> pad_forces(const RobotReport& robot, const SceneBodies& scene);

/// First frame in which something presses on a gel; nothing if there is none.
std::optional<int> first_contact(const SceneBodies& scene);

/// Summary of the implicit coupling: time windows, coupling iterations ("tries"), and residuals.
struct CouplingSum {
  int windows = 0, tries = 0,
      most_tries = 0;     // totals of windows and iterations; largest number of iterations of one window
  int cut = 0;            // windows that had to be halved
  double residual = 0.0;  // largest relative residual of an accepted iteration
  int by_position = 0;    // windows whose gel responses jump, which were accepted by the robot's position
  double apart_m = 0.0;   // largest distance between gels and robot in these windows
};
CouplingSum sum_of(const std::vector<CouplingTry>& tries);

/// Text such as "All 22 windows agreed after 1 to 4 tries …".
std::string coupling_text(const RobotReport& robot);

inline constexpr const char* kRobotStrip = "robot_strip.png";

/// Caption words for the colours of pictures with bodies of these kinds.
std::string picture_key(const std::vector<std::string>& kinds, bool robot);

/// Sections of the page.
/// \param frames frames from steps_over_time
/// \param pictures true if the strip lies next to the page
std::string robot_sections(const RobotReport& robot, const SceneBodies& scene, const std::vector<Instant>& frames,
                           bool pictures);

}  // namespace tacipc
