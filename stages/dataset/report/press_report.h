// Reads the results of press from its folder, and the records of its gel and object.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/stage/record.h"
#include "stages/dataset/report/sample.h"

namespace tacipc {

/// Fills in the content of press.yaml.
/// \throw DataError for malformed content
void read_press_record(const Record& press, SampleReport& sample);

/// \throw SolverError for the first check of `read_press_record` that fails
void judge_press(const Record& press, const SampleReport& sample);

/// Fills in the results of the finished press in `folder`, as far as they are valid.
/// \throw DataError for malformed content
/// \throw SolverError for a failed check
void read_press(const std::filesystem::path& folder, SampleReport& sample);

/// The pressed gel or object, by its name among the inputs of the record. If it does not exist any more, returns
/// nothing and sets `why`.
std::optional<std::filesystem::path> pressed_input(const std::filesystem::path& folder, const Record& press,
                                                   const std::string& input, std::string& why);

/// Frames whose pictures are shown: the ends of the phases, a handful.
std::vector<int> pictured_frames(const SampleReport& sample);

/// Adds a link to a file that exists.
void link_if_there(std::vector<std::pair<std::string, std::filesystem::path>>& links, const std::string& label,
                   const std::filesystem::path& path);

}  // namespace tacipc
