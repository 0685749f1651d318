#include "stages/dataset/report/stage_log.h"

#include <fmt/core.h>

#include <cctype>
#include <sstream>

#include "common/base/files.h"

namespace tacipc {
namespace {

/// Length of "2024-06-07 12:34:56.789 ", with which every message starts.
constexpr std::size_t kTimeLength = 24;

bool starts_with_time(const std::string& line) {
  constexpr std::string_view kPattern = "0000-00-00 00:00:00.000 ";
  if (line.size() < kTimeLength) return false;
  for (std::size_t i = 0; i < kTimeLength; ++i) {
    const bool digit = std::isdigit(static_cast<unsigned char>(line[i])) != 0;
    if (kPattern[i] == '0' ? !digit : line[i] != kPattern[i]) return false;
  }
  return true;
}

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
    if (starts_with_time(line)) {
      const std::string rest = line.substr(kTimeLength);
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
