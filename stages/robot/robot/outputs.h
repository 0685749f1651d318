// The files of a robot's run, and what the next try of a window reads of them.
#pragma once

#include <filesystem>

#include "common/stage/stage.h"
#include "stages/robot/robot/run.h"

namespace tacipc {

/// Arrays of the run, the shapes of its bodies, its contacts, its state, the scene for `press` with the paths of its
/// gels; of a window its path and the answers that it began from.
void write_outputs(Stage& stage, const TaskSpec& task, const std::vector<TaskObject>& objects, const RobotModel& robot,
                   const std::vector<Matrix4>& object_start, const RobotRun& run, const WindowAnswers* answers);

/// The run of a folder, with the path of its window.
RobotRun read_run(const std::filesystem::path& folder);
/// The answers that a window began from; empty of a first try.
std::vector<std::vector<PadAnswer>> read_basis(const std::filesystem::path& folder, std::size_t pads);

/// Answers of the press to the frames from `first` on. \throw DataError if the press has other bodies or fewer frames
WindowAnswers read_answers(const std::filesystem::path& press, const TaskSpec& task,
                           const std::vector<TaskObject>& objects, std::size_t first);

/// What was in front of each pad.
double gap_of(const TaskSpec& task, const std::vector<TaskObject>& objects, std::size_t pad,
              const Matrix4& world_from_gel, const std::vector<Matrix4>& object_poses);

}  // namespace tacipc
