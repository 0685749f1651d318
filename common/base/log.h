// Messages to standard error and to the stage's log file; progress lines on a terminal only.
#pragma once

#include <fmt/core.h>

#include <string>
#include <utility>

namespace tacipc {

void log_message(int level, const std::string& text);

template <typename... Args>
void log_debug(fmt::format_string<Args...> format, Args&&... args) {
  log_message(1, fmt::format(format, std::forward<Args>(args)...));
}
template <typename... Args>
void log_info(fmt::format_string<Args...> format, Args&&... args) {
  log_message(2, fmt::format(format, std::forward<Args>(args)...));
}
template <typename... Args>
void log_warning(fmt::format_string<Args...> format, Args&&... args) {
  log_message(3, fmt::format(format, std::forward<Args>(args)...));
}

/// One line that overwrites itself, with the time left estimated from `fraction` of the work done; nothing off a
/// terminal.
void show_progress(double fraction, const std::string& text);

/// Settings of the log: the stage's name, its log file, and the lowest level that is logged.
/// Levels: debug, info, warning, error, off.
void open_log(const std::string& stage, const std::string& level);
void open_log_file(const std::string& path);
/// Logs an error at any level.
void log_error(const std::string& text);
void close_log();

}  // namespace tacipc
