// What a page shows of a robot beside its scene: the task, forces on its pads, what its actuators did, its hold of the
// object, and how robot and press came to agree.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/sample/scene_folder.h"
#include "stages/dataset/report/robot_report.h"
#include "stages/dataset/report/timeline.h"

namespace tacipc {

/// The frames with the steps of the task as their phases. \throw DataError if the robot has other frames, or
/// its task no steps
std::vector<Instant> steps_over_time(const RobotReport& robot, std::vector<Instant> frames);

/// A force on a pad into it, and along its front, N.
struct PadForce {
  double normal_n = 0.0, tangential_n = 0.0;
};
/// Of a force (N) on a gel, in the axes of the world.
PadForce pad_force(const Matrix4& world_from_gel, const Vector3& force_n);

/// Of one pad, frame by frame.
struct PadForces {
  std::string pad;
  std::vector<PadForce> answered, felt;  // by the press, by the robot
  double apart_n = 0.0;                  // largest length of their difference
};
/// \throw DataError if a pad is no gel of the scene
std::vector<PadForces> pad_forces(const RobotReport& robot, const SceneBodies& scene);

/// The first frame in which something presses on a gel; nothing: none does.
std::optional<int> first_contact(const SceneBodies& scene);

/// How many windows there were, tries in all, and what they came to.
struct CouplingSum {
  int windows = 0, tries = 0, most_tries = 0;  // in all; of one window
  int cut = 0;                                 // windows that had to be halved
  double residual = 0.0;                       // the largest relative residual of an accepted try
  int by_position = 0;                         // windows whose gels' answers jump: accepted by the robot's place
  double apart_m = 0.0;                        // of these, at most
};
CouplingSum sum_of(const std::vector<CouplingTry>& tries);

/// "All 22 windows agreed after 1 to 4 tries …"
std::string coupling_text(const RobotReport& robot);

inline constexpr const char* kRobotStrip = "robot_strip.png";

/// What the colours of pictures with bodies of these kinds are, as words of a caption.
std::string picture_key(const std::vector<std::string>& kinds, bool robot);

/// The sections on the page; `frames`: of steps_over_time. `pictures`: whether the strip lies beside it.
std::string robot_sections(const RobotReport& robot, const SceneBodies& scene, const std::vector<Instant>& frames,
                           bool pictures);

}  // namespace tacipc
