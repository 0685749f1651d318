// What press left in its folder, and the records beside its gel and object.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/stage/record.h"
#include "stages/dataset/report/sample.h"

namespace tacipc {

/// Fills in what press.yaml alone tells. \throw DataError for what is malformed.
void read_press_record(const Record& press, SampleReport& sample);

/// \throw SolverError for the first check of `read_press_record` that is not held.
void judge_press(const Record& press, const SampleReport& sample);

/// Fills in what the finished press in `folder` tells, as far as it is sound.
/// \throw DataError for what is malformed, SolverError for a check that is not held.
void read_press(const std::filesystem::path& folder, SampleReport& sample);

/// The gel or object that was pressed, by its name among the inputs of the record; where it is not there any more,
/// nothing, and why.
std::optional<std::filesystem::path> pressed_input(const std::filesystem::path& folder, const Record& press,
                                                   const std::string& input, std::string& why);

/// Frames of which pictures are shown: the ends of the phases, a handful.
std::vector<int> pictured_frames(const SampleReport& sample);

/// Adds a link to a file that exists.
void link_if_there(std::vector<std::pair<std::string, std::filesystem::path>>& links, const std::string& label,
                   const std::filesystem::path& path);

}  // namespace tacipc
