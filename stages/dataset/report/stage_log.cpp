#include "stages/dataset/report/stage_log.h"

#include <fmt/core.h>

#include <regex>
#include <sstream>

#include "common/base/files.h"

namespace tacipc {
namespace {

/// "2024-06-07 12:34:56.789 ", with which every message starts.
const std::regex kTime(R"(\d{4}-\d\d-\d\d \d\d:\d\d:\d\d\.\d{3} )");

std::string trimmed(const std::string& line) {
  const auto first = line.find_first_not_of(" \t\r");
  if (first == std::string::npos) return "";
  return line.substr(first, line.find_last_not_of(" \t\r") - first + 1);
}

}  // namespace

std::vector<std::string> log_messages(const std::filesystem::path& log, const std::string& level) {
  std::vector<std::string> messages;
  if (!std::filesystem::is_regular_file(log)) return messages;
  std::istringstream lines(read_file(log));
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (std::smatch time; std::regex_search(line, time, kTime, std::regex_constants::match_continuous)) {
      const std::string rest = time.suffix();
      inside = rest.starts_with(level + ": ");
      if (inside) messages.push_back(trimmed(rest.substr(level.size() + 2)));
    } else if (inside && !trimmed(line).empty()) {
      messages.back() += fmt::format(" {}", trimmed(line));
    }
  }
  return messages;
}

std::string failure_reason(const std::filesystem::path& stage_folder, const std::string& stage) {
  const std::filesystem::path log = stage_folder / (stage + ".log");
  if (!std::filesystem::is_regular_file(log)) return fmt::format("{} did not run", stage);
  const auto errors = log_messages(log, "error");
  if (errors.empty()) return fmt::format("{} ended before it was done, without an error message", stage);
  const std::string prefix = stage + ": error: ";
  const std::string& last = errors.back();
  return fmt::format("{}: {}", stage, last.starts_with(prefix) ? last.substr(prefix.size()) : last);
}

}  // namespace tacipc
