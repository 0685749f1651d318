// Writes the folder of a robot run, and reads from it the data that the next coupling iteration needs.
#pragma once

#include <filesystem>

#include "common/stage/stage.h"
#include "stages/robot/robot/run.h"

namespace tacipc {

/// Writes the outputs of a run: arrays, shapes of the bodies, contact events, the state, the scene for `press` and the
/// gels' paths. A run of a time window also stores the responses that it began from.
/// \param object_start pose of each object at the start of the task
/// \param answers null in the first iteration of a window
void write_outputs(Stage& stage, const TaskSpec& task, const std::vector<TaskObject>& objects, const RobotModel& robot,
                   const std::vector<Matrix4>& object_start, const RobotRun& run, const WindowAnswers* answers);

/// Reads the run of a folder, including its time window.
RobotRun read_run(const std::filesystem::path& folder);
/// Reads the responses that a window's iteration began from.
/// \return empty for the first iteration
std::vector<std::vector<PadAnswer>> read_basis(const std::filesystem::path& folder, std::size_t pads);

/// Reads the responses of the press to the frames from `first` on.
/// \throw DataError if the press lacks a body of the task, or frames after `first`
WindowAnswers read_answers(const std::filesystem::path& press, const TaskSpec& task,
                           const std::vector<TaskObject>& objects, std::size_t first);

/// Returns the gap between a pad and the nearest object in front of it, m; 1 m if there is none nearer.
double gap_of(const TaskSpec& task, const std::vector<TaskObject>& objects, std::size_t pad,
              const Matrix4& world_from_gel, const std::vector<Matrix4>& object_poses);

}  // namespace tacipc
