// A robot that goes through its task, or a window of it between the answers of a press.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/sample/robot_folder.h"
#include "stages/robot/robot/coupling.h"
#include "stages/robot/robot/mjcf_model.h"

namespace tacipc {

/// Two geoms, or a pad and what its gel touches, begin or end to touch.
struct ContactEvent {
  double time_s = 0.0;
  std::string first, second;
  bool begins = true;
};

struct RobotRun {
  std::vector<RobotFrame> frames;    // from the start of the task
  std::vector<ContactEvent> events;  // the same
  std::vector<double> state;         // what the next window goes on from
  bool finished = false;             // the task is over
};

/// The answers of a press to a window's earlier try: for each frame of it, its first and last instant included, each
/// pad.
struct WindowAnswers {
  std::vector<std::vector<PadAnswer>> frames;
  std::vector<std::vector<double>> stiffness_n_m;  // of the spring between this answer and the next, as frames
  std::vector<double> inertia_n_m;                 // m/h² of each object of the task, h the time of a frame
  std::vector<std::vector<Matrix4>> objects;       // where the press had the rigid objects, for each frame
  std::vector<std::vector<bool>> floats;           // whether nothing but gels touches an object, for each frame
};

/// How far a try was from what the press answered to it.
struct TryJudgement {
  Residual residual;
  double stiffness_n_m = 0.0;  // of a gel, as far as known
};

/// Compares what the pads of a try felt in its window, which begins with frame `first`, with the answers to it, and
/// gives these the springs of the next try. \param basis the answers that the try began from, empty of a first try
/// \param stiffness_n_m of the try. \throw DataError if try and answers have not as many frames
TryJudgement judge_try(const TaskSpec& task, const RobotRun& tried, std::size_t first,
                       const std::vector<std::vector<PadAnswer>>& basis, double stiffness_n_m, WindowAnswers& answers);

/// How far the pads of a run are from where they were answered, at most, in frames after `first`: of the origin of S,
/// and of a point 10 mm beside it as the pad turns. Infinite where there are not as many frames.
double position_residual_m(const RobotRun& run, std::size_t first, const WindowAnswers& answers);

struct Window {
  const RobotRun* before = nullptr;        // the task so far; none at its start
  const WindowAnswers* answers = nullptr;  // none in the first try
  /// What the pads feel, and how far things are from them, where the window begins: for the first try.
  std::vector<PadAnswer> at_start = {};
  std::vector<Matrix4> objects_at_start = {};
  int frames = 0;              // of the window, fewer if the task ends before
  double stiffness_n_m = 0.0;  // of the spring between two answers
  bool exact = false;          // the pads feel the answers as they are, wherever they go
};

using RobotProgress = std::function<void(double time_s)>;

/// The whole task, by MuJoCo's own contacts. \throw DataError if the motion becomes unstable or a point cannot go where
/// the task says
RobotRun run_alone(const TaskSpec& task, RobotModel& robot, const RobotProgress& progress);

/// A window of it, by the wrenches of coupling.h.
RobotRun run_window(const TaskSpec& task, RobotModel& robot, const Window& window);

}  // namespace tacipc
