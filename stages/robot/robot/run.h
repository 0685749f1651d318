// Runs a robot through its whole task, or through one time window of a coupled run.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/sample/robot_folder.h"
#include "stages/robot/robot/coupling.h"
#include "stages/robot/robot/mjcf_model.h"

namespace tacipc {

/// Beginning or end of a contact between two geoms, or between a pad and its gel's counterpart.
struct ContactEvent {
  double time_s = 0.0;
  std::string first, second;  // names; `second` is "gel" for a contact of a pad's gel
  bool begins = true;
};

/// Motion of a robot from the start of its task.
struct RobotRun {
  std::vector<RobotFrame> frames;    // one per interval of the press, frame 0 first
  std::vector<ContactEvent> events;  // contacts since the start of the task
  std::vector<double> state;         // state from which the next window resumes
  bool finished = false;             // whether the task is over
};

/// Responses of the press to an earlier iteration of a time window: one list of pads per frame, including the first and
/// last instant of the window.
struct WindowAnswers {
  std::vector<std::vector<PadAnswer>> frames;
  std::vector<std::vector<double>> stiffness_n_m;  // spring of the surrogate contact law, per frame and pad
  std::vector<double> inertia_n_m;                 // m/h² of each object of the task, h the frame interval
  std::vector<std::vector<Matrix4>> objects;       // world_from_body of the rigid objects in the press, per frame
  std::vector<std::vector<bool>> floats;           // whether only gels touch an object, per frame and object
};

/// How well an iteration agrees with the response of the press.
struct TryJudgement {
  Residual residual;
  double stiffness_n_m = 0.0;  // estimated stiffness of a gel
};

/// Compares the wrenches that an iteration applied to its pads with the responses of the press, and sets the springs
/// (`answers.stiffness_n_m`) of the next iteration.
/// \param first frame at which the window begins
/// \param basis responses that the iteration began from; empty for the first iteration
/// \param stiffness_n_m stiffness that the iteration assumed
/// \throw DataError if iteration and response differ in their number of frames
TryJudgement judge_try(const TaskSpec& task, const RobotRun& tried, std::size_t first,
                       const std::vector<std::vector<PadAnswer>>& basis, double stiffness_n_m, WindowAnswers& answers);

/// Returns the largest distance between a pad and the pose for which the press computed its response, m, in frames
/// after `first`. It is measured at the origin of S; a rotation counts as the path of a point 10 mm away. Infinite if
/// the numbers of frames differ.
double position_residual_m(const RobotRun& run, std::size_t first, const WindowAnswers& answers);

/// Input of run_window().
struct Window {
  const RobotRun* before = nullptr;        // run up to the window; null at the start of the task
  const WindowAnswers* answers = nullptr;  // responses to the last iteration; null in the first one
  // Used in the first iteration only: response and gap of each pad, and poses of the rigid objects, at the window's
  // start.
  std::vector<PadAnswer> at_start = {};
  std::vector<Matrix4> objects_at_start = {};
  int frames = 0;              // length of the window; the run ends earlier if the task does
  double stiffness_n_m = 0.0;  // spring of the surrogate contact law in the first iteration
  bool exact = false;          // true: apply the responses unchanged, wherever the pads move
};

/// Called in each time step of the model.
using RobotProgress = std::function<void(double time_s)>;

/// Runs the whole task with MuJoCo's own contacts.
/// \throw DataError if the motion becomes unstable or a site cannot reach its target
RobotRun run_alone(const TaskSpec& task, RobotModel& robot, const RobotProgress& progress);

/// Runs one time window with the surrogate contact law of coupling.h.
/// \throw DataError as run_alone()
RobotRun run_window(const TaskSpec& task, RobotModel& robot, const Window& window);

}  // namespace tacipc
