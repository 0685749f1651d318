// What a stage's log says went wrong.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tacipc {

/// The messages of one level ("error", "warning") in a log, oldest first, without time and level. A message of several
/// lines becomes one. Empty if there is no such file.
std::vector<std::string> log_messages(const std::filesystem::path& log, const std::string& level);

/// Why a stage left no record: the last error in its log without the "press: error: " before it, or, where it had no
/// chance to write one, that.
std::string failure_reason(const std::filesystem::path& stage_folder, const std::string& stage);

}  // namespace tacipc
