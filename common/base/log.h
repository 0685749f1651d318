// Logs messages to standard error and to the stage's log file; shows progress on a terminal only.
#pragma once

#include <fmt/core.h>

#include <string>
#include <utility>

namespace tacipc {

/// Logs at a level: 1 debug, 2 info, 3 warning.
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

/// Shows a progress line that overwrites itself, with the time left estimated from the completed `fraction`. Does
/// nothing if standard error is not a terminal.
void show_progress(double fraction, const std::string& text);

/// Configures the log: name of the stage and lowest level that is logged, then the log file.
/// Levels: debug, info, warning, error, off.
void open_log(const std::string& stage, const std::string& level);
void open_log_file(const std::string& path);
/// Logs an error at any level setting.
void log_error(const std::string& text);
void close_log();

}  // namespace tacipc
