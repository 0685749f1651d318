// run_stage(): flags, lock, log and exit code around a stage's run.
#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <memory>
#include <new>
#include <system_error>
#include <thread>

#include "common/base/blas.h"
#include "common/base/error.h"
#include "common/base/fragile_library.h"
#include "common/base/log.h"
#include "common/stage/self_description.h"
#include "common/stage/stage.h"

namespace tacipc {
namespace fs = std::filesystem;
namespace {

/// Keeps two processes from writing one folder: after its make was killed, a stage may still run when the next begins.
class FolderLock {
 public:
  explicit FolderLock(const fs::path& path) : file_(::open(path.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666)) {
    if (file_ < 0) throw DataError("{}: cannot be written: {}", path.string(), std::strerror(errno));
    if (::flock(file_, LOCK_EX | LOCK_NB) == 0) return;
    log_info("waiting for another run that writes to {}", path.parent_path().string());
    while (::flock(file_, LOCK_EX) != 0) {
      if (errno != EINTR) throw DataError("{}: cannot be locked: {}", path.string(), std::strerror(errno));
    }
  }
  ~FolderLock() { ::close(file_); }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_;
};

/// Usage text that calls a stage through tacipc, because shells have a command of the same name as one stage: export.
class UsageThroughTacipc : public CLI::Formatter {
 public:
  std::string make_usage(const CLI::App* app, std::string name) const override {
    return CLI::Formatter::make_usage(app, "tacipc " + name);
  }
};

/// Splits NAME=PATH at its first '='.
NamedPath split_named_path(const std::string& text) {
  const std::size_t at = text.find('=');
  if (at == std::string::npos) return {.name = "", .path = text};
  return {.name = text.substr(0, at), .path = text.substr(at + 1)};
}

/// Returns the problem with the path of an input; empty if there is none.
std::string fault_of_path(std::string& path) {
  std::string fault = CLI::ExistingPath(path);
  if (!fault.empty()) return fault;
  // Reading a pipe would wait until another process writes to it.
  const auto has_content = [](fs::file_type type) {
    return type == fs::file_type::regular || type == fs::file_type::directory;
  };
  if (!has_content(fs::status(path).type()))
    return fmt::format("{} is a pipe or a device, expected a file or folder", path);
  if (!fs::is_directory(path)) return fault;
  std::error_code error;
  for (fs::recursive_directory_iterator entry(path, fs::directory_options::skip_permission_denied, error), end;
       entry != end; entry.increment(error)) {
    const fs::file_type type = entry->status(error).type();
    if (!has_content(type) && type != fs::file_type::not_found && type != fs::file_type::none)
      return fmt::format("{} is a pipe or a device, expected a file or folder", entry->path().string());
  }
  return fault;
}

/// Returns the problem with a NAME=PATH; empty if there is none.
std::string fault_of_named_path(const std::string& text) {
  const auto [name, path] = split_named_path(text);
  if (name.empty()) return fmt::format("'{}' is not NAME=PATH", text);
  std::string given = path.string();
  return fault_of_path(given);
}

/// Returns the sections after the flags on a stage's manual page.
std::vector<ManSection> manual_sections(const std::string& stage) {
  return {
      {.title = "FILES",
       .paragraphs = {fmt::format("{0}.yaml in the folder of --out is the record, written last: inputs with hashes, "
                                  "the configuration with every value used, outputs, summary. Work that failed leaves "
                                  "{0}.failed.yaml with the reason. What the run cost is in {0}.timings.yaml.",
                                  stage)}},
      {.title = "EXIT STATUS",
       .paragraphs = {"0 done, 1 the work failed, 2 flags or configuration are wrong, 3 with --if-changed: nothing has "
                      "changed."}}};
}

}  // namespace

int run_stage(const StageSpec& spec, int argc, char** argv, const std::function<void(Stage&)>& body) {
  try {
    leave_blas_threads(argv);
    return Stage::run_here(spec, argc, argv, body);
  } catch (const std::bad_alloc&) {
    // Reached before the work began or after it; Stage::run() handles errors of the work itself.
    std::fputs((spec.name + ": error: out of memory\n").c_str(), stderr);
    return 1;
  }
}

int Stage::run_here(const StageSpec& spec, int argc, char** argv, const std::function<void(Stage&)>& body) {
  CLI::App app(spec.summary, spec.name);
  app.formatter(std::make_shared<UsageThroughTacipc>());
  std::map<std::string, std::vector<fs::path>> inputs;
  std::map<std::string, std::vector<std::string>> named;
  std::map<std::string, std::string> options;
  std::string out, level = "info";
  int threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  for (const InputSpec& input : spec.inputs) {
    CLI::Option* option = input.named
                              ? app.add_option(input.flag, named[input.flag], input.help)->check(fault_of_named_path)
                              : app.add_option(input.flag, inputs[input.flag], input.help)
                                    ->check(CLI::Validator(fault_of_path, "PATH(existing)"));
    option->required(input.required)
        ->expected(1, input.many ? 1 << 20 : 1)
        ->type_name(input.named ? "NAME=PATH" : "PATH");
  }
  for (const OptionSpec& spec_option : spec.options) {
    options[spec_option.flag] = spec_option.fallback;
    if (spec_option.is_switch)
      app.add_flag_callback(
          spec_option.flag, [&word = options[spec_option.flag]] { word = "true"; }, spec_option.help);
    else
      app.add_option(spec_option.flag, options[spec_option.flag], spec_option.help)->capture_default_str();
  }
  app.add_option("--out", out, "folder the results go to")->required()->type_name("DIR");
  app.add_option("--threads", threads, "threads to use (results do not depend on it)")
      ->check(CLI::Range(1, 4096))
      ->default_str("all cores");
  app.add_option("--log-level", level, "level of messages")
      ->check(CLI::IsMember({"debug", "info", "warning", "error", "off"}));
  bool if_changed = false;
  app.add_flag("--if-changed", if_changed,
               "do nothing, and exit with 3, if the record in --out is of these very inputs and options, whatever "
               "their dates");
  app.set_version_flag("--version", spec.name + " " + program_version());
  add_answers(app, manual_sections(spec.name));
  if (const auto code = parse_flags(app, argc, argv, fmt::format("tacipc {} --help", spec.name))) return *code;

  // A file-size limit must end in a message, as a full disk does, not in a signal.
  std::signal(SIGXFSZ, SIG_IGN);
  open_log(spec.name, level);
  std::function<void(Stage&)> work = body;
  if (spec.works_in_child) {
    if (const auto end = continue_in_child()) {
      if (end->crash.empty()) return end->code;
      work = [crash = end->crash](Stage&) { throw DataError(crash); };  // cleans up and reports the crash
    }
  }
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  const auto started = std::chrono::steady_clock::now();
  Stage stage(spec, fs::path(out).lexically_normal(), threads);
  stage.inputs_ = std::move(inputs);
  for (const auto& [flag, texts] : named)
    std::ranges::transform(texts, std::back_inserter(stage.named_inputs_[flag]), split_named_path);
  stage.options_ = std::move(options);
  int code = 1;
  try {
    std::error_code error;
    fs::create_directories(stage.out_, error);
    if (error) throw DataError("{}: cannot be created: {}", stage.out_.string(), error.message());
    const FolderLock lock(stage.out_ / (".lock-" + spec.name));
    code = if_changed && stage.is_done() ? 3 : stage.run(work);
  } catch (const std::exception& error) {
    log_error(fmt::format("{}: error: {}", spec.name, error.what()));
    std::error_code ignored;
    if (!spec.keeps_old_until_done) fs::remove(stage.out_ / (spec.name + ".yaml"), ignored);
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  log_debug("wall_s: {:.2f} cpu_s: {:.2f} peak_memory_mib: {}", wall, seconds(usage.ru_utime) + seconds(usage.ru_stime),
            usage.ru_maxrss / 1024);
  close_log();
  return code;
}

}  // namespace tacipc
