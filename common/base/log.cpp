#include "common/base/log.h"

#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <memory>

#include "common/base/printable.h"

namespace tacipc {
namespace {

std::shared_ptr<spdlog::logger> terminal;
std::shared_ptr<spdlog::logger> file;
std::string stage_name;
bool progress_shown = false;
std::chrono::steady_clock::time_point started = std::chrono::steady_clock::now();

/// Prints without throwing (unlike fmt::print) if nothing can be written, since the message may report just that.
void say(const std::string& text) { std::fputs(text.c_str(), stderr); }

void end_progress_line() {
  if (progress_shown) say("\r\033[K");
  progress_shown = false;
}

}  // namespace

void open_log(const std::string& stage, const std::string& level) {
  stage_name = stage;
  started = std::chrono::steady_clock::now();
  terminal = std::make_shared<spdlog::logger>(stage, std::make_shared<spdlog::sinks::stderr_sink_st>());
  terminal->set_pattern("%n: %v");
  terminal->set_level(spdlog::level::from_str(level == "error" ? "err" : level));
}

void open_log_file(const std::string& path) {
  file = std::make_shared<spdlog::logger>(stage_name, std::make_shared<spdlog::sinks::basic_file_sink_st>(path, true));
  file->set_pattern("%Y-%m-%d %H:%M:%S.%e %l: %v");
  file->set_level(spdlog::level::debug);
  file->set_error_handler([](const std::string&) {});  // a full disk is reported elsewhere
  file->flush_on(spdlog::level::info);
}

void log_message(int level, const std::string& message) {
  end_progress_line();
  const std::string text = printable(message);
  const auto at = static_cast<spdlog::level::level_enum>(level);
  if (terminal) terminal->log(at, level == spdlog::level::warn ? "warning: " + text : text);
  if (file) file->log(at, text);
}

void log_error(const std::string& message) {
  end_progress_line();
  const std::string text = printable(message);
  // Printed directly, because an error is logged at any level setting.
  say(text + "\n");
  if (file) file->error(text);
}

void close_log() {
  end_progress_line();
  if (file) file->flush();
  file.reset();
}

void show_progress(double fraction, const std::string& text) {
  static const bool is_terminal = isatty(STDERR_FILENO) != 0;
  if (!is_terminal || !terminal || terminal->level() > spdlog::level::info) return;
  const double spent = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  std::string left;
  if (fraction > 0.01 && fraction < 1.0) left = fmt::format(", {:.0f} s left", spent * (1.0 - fraction) / fraction);
  say(fmt::format("\r\033[K{}: {}{}", stage_name, printable(text), left));
  std::fflush(stderr);
  progress_shown = true;
}

}  // namespace tacipc
