#include "common/stage.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <new>
#include <system_error>
#include <thread>

#include "common/error.h"
#include "common/files.h"
#include "common/log.h"

namespace tacipc {
namespace fs = std::filesystem;
namespace {

const char* instruction_set() {
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq"))
    return "x86-64-v4";
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return "x86-64-v3";
  return __builtin_cpu_supports("sse4.2") ? "x86-64-v2" : "x86-64";
}

void remove_quietly(const fs::path& path) {
  std::error_code ignored;
  fs::remove_all(path, ignored);
}

/// As seen from the output folder, so that a moved or second copy of everything gives the same record.
std::string relative_to(const fs::path& path, const fs::path& folder) {
  std::error_code error;
  const fs::path relative = fs::proximate(path, folder, error);
  return (error ? path : relative).generic_string();
}

/// Keeps two processes from writing one folder: a stage whose make was killed may still run when the next begins.
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

}  // namespace

Stage::Stage(const StageSpec& spec, fs::path out, int threads)
    : spec_(spec), out_(std::move(out)), partial_(out_ / (".partial-" + spec.name)), threads_(threads) {}

const fs::path& Stage::input(const std::string& flag) const { return inputs_.at(flag).front(); }

std::optional<fs::path> Stage::optional_input(const std::string& flag) const {
  const auto found = inputs_.find(flag);
  if (found == inputs_.end() || found->second.empty()) return std::nullopt;
  return found->second.front();
}

const std::vector<fs::path>& Stage::inputs(const std::string& flag) const { return inputs_.at(flag); }

const std::string& Stage::option(const std::string& flag) const { return options_.at(flag); }

fs::path Stage::output(const std::string& name) {
  outputs_.push_back(name);
  const fs::path path = partial_ / name;
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  if (error) throw DataError("{}: cannot be created: {}", path.parent_path().string(), error.message());
  return path;
}

void Stage::note(const std::string& key, Value value) { notes_.emplace_back(key, std::move(value)); }

void Stage::note_config(const std::string& flag, Value config) {
  configs_.emplace_back(flag.substr(2), std::move(config));
}

void Stage::summarize(const Value::Map& lines) { summary_.insert(summary_.end(), lines.begin(), lines.end()); }

Value Stage::input_hashes() const {
  Value::Map inputs;
  for (const InputSpec& spec : spec_.inputs) {
    const auto found = inputs_.find(spec.flag);
    if (found == inputs_.end() || found->second.empty()) continue;
    Value::List list;
    for (const fs::path& path : found->second) {
      list.emplace_back(Value::Map{{"path", relative_to(path, out_)}, {"hash", content_hash(path)}});
    }
    inputs.emplace_back(spec.flag.substr(2), spec.many ? Value(std::move(list)) : list.front());
  }
  return inputs;
}

void Stage::remove_old_results() const {
  const fs::path record = out_ / (spec_.name + ".yaml");
  std::error_code error;
  if (!fs::exists(record, error)) return;
  // The record goes first: what it lists may then be missing without anyone taking it for complete.
  std::vector<std::string> names;
  try {
    names = ConfigReader::from_file(record).section("outputs").keys();
  } catch (const std::exception&) {
    // Not a record of ours; nothing of it can be told from the user's own files.
  }
  fs::remove(record, error);
  if (error) throw DataError("{}: cannot be removed: {}", record.string(), error.message());
  for (const std::string& name : names) {
    const fs::path path = fs::path(name).lexically_normal();
    if (path.is_absolute() || *path.begin() == "..") continue;
    remove_quietly(out_ / path);
    if (path.has_parent_path()) fs::remove(out_ / path.parent_path(), error);  // only if empty now
  }
}

std::string Stage::record() const {
  // A record must name what was really read.
  if (to_yaml(input_hashes()) != to_yaml(inputs_at_start_))
    throw DataError("an input changed while the stage ran; run it again");
  Value::Map outputs;
  for (const std::string& name : outputs_) outputs.emplace_back(name, content_hash(partial_ / name));
  Value::Map record{{"stage", spec_.name},
                    {"version", program_version()},
                    {"instruction_set", instruction_set()},
                    {"inputs", inputs_at_start_},
                    {"outputs", std::move(outputs)}};
  for (const auto& note : notes_) record.push_back(note);
  for (const OptionSpec& option : spec_.options) record.emplace_back(option.flag.substr(2), options_.at(option.flag));
  record.emplace_back("config", configs_);
  record.emplace_back("summary", summary_);
  return to_yaml(record);
}

void Stage::publish() {
  const std::string text = record();
  const fs::path record_name = spec_.name + ".yaml";
  fs::create_directories(partial_);
  write_file(partial_ / record_name, text);
  for (const std::string& name : outputs_) {
    if ((out_ / name).has_parent_path()) fs::create_directories((out_ / name).parent_path());
    fs::rename(partial_ / name, out_ / name);
  }
  fs::rename(partial_ / record_name, out_ / record_name);
}

int run_stage(const StageSpec& spec, int argc, char** argv, const std::function<void(Stage&)>& body) {
  CLI::App app(spec.summary, spec.name);
  std::map<std::string, std::vector<fs::path>> inputs;
  std::map<std::string, std::string> options;
  std::string out, level = "info";
  int threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  for (const InputSpec& input : spec.inputs) {
    auto* option =
        app.add_option(input.flag, inputs[input.flag], input.help)->required(input.required)->check(CLI::ExistingPath);
    option->expected(1, input.many ? 1 << 20 : 1)->type_name("PATH");
  }
  for (const OptionSpec& spec_option : spec.options) {
    options[spec_option.flag] = spec_option.fallback;
    app.add_option(spec_option.flag, options[spec_option.flag], spec_option.help)->capture_default_str();
  }
  app.add_option("--out", out, "folder the results go to")->required()->type_name("DIR");
  app.add_option("--threads", threads, "threads to use (results do not depend on it)")
      ->check(CLI::Range(1, 4096))
      ->capture_default_str();
  app.add_option("--log-level", level, "how much to say")
      ->check(CLI::IsMember({"debug", "info", "warning", "error", "off"}));
  app.set_version_flag("--version", spec.name + " " + program_version());
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    fmt::print(stderr, "{}: error: {} (see {} --help)\n", spec.name, error.what(), spec.name);
    return 2;
  }

  // A file-size limit must end in a message like a full disk does, not in a signal.
  std::signal(SIGXFSZ, SIG_IGN);
  open_log(spec.name, level);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  const auto started = std::chrono::steady_clock::now();
  Stage stage(spec, fs::path(out).lexically_normal(), threads);
  stage.inputs_ = std::move(inputs);
  stage.options_ = std::move(options);
  const fs::path record = stage.out_ / (spec.name + ".yaml");
  int code = 1;
  try {
    std::error_code error;
    fs::create_directories(stage.out_, error);
    if (error) throw DataError("{}: cannot be created: {}", stage.out_.string(), error.message());
    const FolderLock lock(stage.out_ / (".lock-" + spec.name));
    stage.remove_old_results();
    remove_quietly(stage.partial_);
    write_file(stage.out_ / (spec.name + ".log"), "");
    open_log_file((stage.out_ / (spec.name + ".log")).string());
    stage.inputs_at_start_ = stage.input_hashes();
    body(stage);
    stage.publish();
    code = 0;
  } catch (const ConfigError& error) {
    log_error(error.what());
    code = 2;
  } catch (const UsageError& error) {
    log_error(fmt::format("{}: error: {}", spec.name, error.what()));
    code = 2;
  } catch (const std::bad_alloc&) {
    log_error(fmt::format("{}: error: out of memory", spec.name));
  } catch (const std::exception& error) {
    log_error(fmt::format("{}: error: {}", spec.name, error.what()));
  }
  remove_quietly(stage.partial_);
  if (code != 0) remove_quietly(record);
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
