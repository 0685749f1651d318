// Reads failures from a stage's log.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tacipc {

/// Messages of one level ("error", "warning") in a log, oldest first, without time and level. A message of several
/// lines becomes one. Empty if there is no such file.
std::vector<std::string> log_messages(const std::filesystem::path& log, const std::string& level);

/// Reason why a stage left no record: its name and the last error in its log, without the leading "press: error: ". If
/// there is no log or no error, the text states that.
std::string failure_reason(const std::filesystem::path& stage_folder, const std::string& stage);

}  // namespace tacipc
