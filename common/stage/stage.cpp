#include "common/stage/stage.h"

#include <sys/resource.h>

#include <fmt/core.h>

#include <algorithm>
#include <new>
#include <sstream>
#include <system_error>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/base/instruction_set.h"
#include "common/base/log.h"
#include "common/base/printable.h"
#include "common/stage/vouched.h"

namespace tacipc {
namespace fs = std::filesystem;
namespace {

constexpr const char* kOutOfMemory = "out of memory";
// Hidden name, so that no output can have it.
constexpr const char* kReplacing = ".replacing-";  // prefix of a list of files that may lack a record

void remove_quietly(const fs::path& path) {
  std::error_code ignored;
  fs::remove_all(path, ignored);
}

/// Returns a path relative to the output folder, so that a moved or second copy of everything gives the same record.
/// \throw UsageError for a name that a record, which is UTF-8, cannot hold
std::string relative_to(const fs::path& path, const fs::path& folder) {
  std::error_code error;
  const fs::path relative = fs::proximate(path, folder, error);
  std::string name = (error ? path : relative).generic_string();
  if (!is_utf8(name)) throw UsageError(printable(name) + ": its name is not UTF-8; rename or link it");
  return name;
}

/// Returns an error's message, with the path first if the file system is the cause.
std::string reason_of(const std::exception& error) {
  // oneTBB's message if it gets no memory for a thread, or no further thread is allowed.
  if (std::string_view(error.what()).starts_with("pthread_create has failed"))
    return fmt::format("{}: a thread cannot be started ({})", kOutOfMemory, error.what());
  const auto* of_files = dynamic_cast<const fs::filesystem_error*>(&error);
  return of_files ? fmt::format("{}: {}", of_files->path1().string(), of_files->code().message()) : error.what();
}

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

const std::vector<NamedPath>& Stage::named_inputs(const std::string& flag) const { return named_inputs_.at(flag); }

const std::string& Stage::option(const std::string& flag) const { return options_.at(flag); }

fs::path Stage::output(const std::string& name) {
  outputs_.push_back({name});
  return partial_path(name);
}

fs::path Stage::varying_output(const std::string& name) {
  outputs_.push_back({name, "varies"});
  return partial_path(name);
}

void Stage::link_output(const std::string& name, const fs::path& file, const std::string& hash) {
  const fs::path path = partial_path(name);
  std::error_code error;
  fs::create_hard_link(fs::canonical(file, error), path, error);
  if (error) fs::copy_file(file, path, error);
  if (error) throw DataError("{}: cannot be linked or copied to {}: {}", file.string(), path.string(), error.message());
  outputs_.push_back({name, hash});
}

fs::path Stage::partial_path(const std::string& name) const {
  open_scratch();
  fs::path path = partial_ / name;
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

void Stage::cost(const Value::Map& lines) { cost_.insert(cost_.end(), lines.begin(), lines.end()); }

Value Stage::input_hashes(const fs::path& from) const {
  Value::Map inputs;
  for (const InputSpec& spec : spec_.inputs) {
    if (spec.named) {
      Value::List list;
      for (const auto& [name, path] : named_inputs_.at(spec.flag))
        list.emplace_back(Value::Map{{"name", name}, {"path", relative_to(path, from)}, {"hash", content_hash(path)}});
      if (!list.empty()) inputs.emplace_back(spec.flag.substr(2), std::move(list));
      continue;
    }
    const auto found = inputs_.find(spec.flag);
    if (found == inputs_.end() || found->second.empty()) continue;
    Value::List list;
    for (const fs::path& path : found->second) {
      list.emplace_back(Value::Map{{"path", relative_to(path, from)}, {"hash", content_hash(path)}});
    }
    inputs.emplace_back(spec.flag.substr(2), spec.many ? Value(std::move(list)) : list.front());
  }
  for (const auto& [name, path] : added_inputs_)
    inputs.emplace_back(name, Value::Map{{"path", relative_to(path, from)}, {"hash", content_hash(path)}});
  return inputs;
}

void Stage::add_input(const std::string& name, const fs::path& path) { add_inputs({{name, path}}); }

void Stage::add_inputs(const std::vector<std::pair<std::string, fs::path>>& named) {
  added_inputs_.insert(added_inputs_.end(), named.begin(), named.end());
  for (const auto& [name, path] : named) refuse_changed(path);
  inputs_at_start_ = input_hashes(out_);
  scratch_is_open_ = false;
}

void Stage::refuse_changed(const fs::path& input) const {
  refuse_changed_outputs(input, out_ / (spec_.name + ".yaml"));
}

void Stage::refuse_changed_inputs() const {
  if (inputs_changed()) throw DataError("an input changed while the stage ran; run it again");
}

bool Stage::inputs_changed() const { return to_yaml(input_hashes(out_)) != to_yaml(inputs_at_start_.value()); }

void Stage::add_notes(Value::Map& record) const {
  record.insert(record.end(), notes_.begin(), notes_.end());
  for (const OptionSpec& option : spec_.options) {
    const std::string& value = options_.at(option.flag);
    if (!value.empty()) record.emplace_back(option.flag.substr(2), printable(value));
  }
}

std::set<std::string> Stage::old_outputs() const {
  std::set<std::string> names;
  std::error_code error;
  if (const fs::path record = out_ / (spec_.name + ".yaml"); fs::exists(record, error)) {
    try {
      for (std::string& name : ConfigReader::from_file(record).section("outputs").keys()) names.insert(std::move(name));
    } catch (const std::exception&) {
      // Not a record of this project; its files cannot be distinguished from the user's own.
    }
  }
  if (const fs::path list = out_ / (kReplacing + spec_.name); fs::exists(list, error)) {
    std::istringstream lines(read_file(list));
    for (std::string name; std::getline(lines, name);) names.insert(name);
  }
  return names;
}

void Stage::remove_output(const std::string& name) const {
  const fs::path path = fs::path(name).lexically_normal();
  if (path.is_absolute() || *path.begin() == "..") return;
  remove_quietly(out_ / path);
  std::error_code ignored;
  // Also remove its folders that are empty now.
  for (fs::path folder = path.parent_path(); !folder.empty() && fs::remove(out_ / folder, ignored);)
    folder = folder.parent_path();
}

void Stage::remove_old_results() const {
  remove_quietly(out_ / (spec_.name + ".timings.yaml"));
  const fs::path record = out_ / (spec_.name + ".yaml");
  std::error_code error;
  if (!fs::exists(record, error)) return;
  // The record goes first: outputs that it lists may then be missing without being taken for complete.
  const std::set<std::string> names = old_outputs();
  fs::remove(record, error);
  if (error) throw DataError("{}: cannot be removed: {}", record.string(), error.message());
  // Records of parts go next, for the same reason.
  const std::string of_part = "/" + spec_.name + ".yaml";
  for (const std::string& name : names) {
    if (name.ends_with(of_part)) remove_output(name);
  }
  for (const std::string& name : names) remove_output(name);
}

void Stage::retire_old_record() {
  // The list of old and new files must outlive the records. Otherwise files that a killed run leaves could not be
  // distinguished from a user's own next to the outputs of the next run.
  std::set<std::string> names = old_outputs();
  for (const Output& output : outputs_) names.insert(output.name);
  std::string list;
  for (const std::string& name : names) list += name + "\n";
  const fs::path beside = partial_path(kReplacing + spec_.name);
  write_file(beside, list);
  fs::rename(beside, out_ / (kReplacing + spec_.name));
  const fs::path record = out_ / (spec_.name + ".yaml");
  std::error_code error;
  fs::remove(record, error);
  if (error) throw DataError("{}: cannot be removed: {}", record.string(), error.message());
}

std::string Stage::record_of(const Value& inputs, const std::string& prefix, const Value::Map& summary) const {
  Value::Map outputs;
  for (const Output& output : outputs_)
    if (output.name.starts_with(prefix))
      outputs.emplace_back(output.name.substr(prefix.size()),
                           output.hash ? *output.hash : content_hash(partial_ / output.name));
  Value::Map record{{"stage", spec_.name},
                    {"version", program_version()},
                    {"instruction_set", instruction_set()},
                    {"inputs", inputs},
                    {"outputs", std::move(outputs)}};
  add_notes(record);
  record.emplace_back("config", configs_);
  record.emplace_back("summary", summary);
  return to_yaml(record);
}

void Stage::finish_part(const std::string& folder, const Value::Map& summary) {
  const std::string prefix = folder + "/", text = record_of(input_hashes(out_ / folder), prefix, summary);
  parts_.push_back(prefix + spec_.name + ".yaml");
  write_file(output(parts_.back()), text);
}

std::string Stage::timings() const {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - started_;
  Value::Map lines{{"stage", spec_.name},
                   {"threads", threads_},
                   {"wall_s", wall.count()},
                   {"processor_s", seconds(used.ru_utime) + seconds(used.ru_stime)},
                   {"peak_memory_mb", 1.024e-3 * static_cast<double>(used.ru_maxrss)}};
  lines.insert(lines.end(), cost_.begin(), cost_.end());
  return to_yaml(lines);
}

void Stage::begin() {
  remove_quietly(out_ / (spec_.name + ".failed.yaml"));
  if (!spec_.keeps_old_until_done) remove_old_results();
  write_file(out_ / (spec_.name + ".log"), "");
  open_log_file((out_ / (spec_.name + ".log")).string());
  if (!spec_.resumable) remove_quietly(partial_);
  for (const auto& [flag, paths] : inputs_)
    for (const fs::path& path : paths) refuse_changed(path);
  for (const auto& [flag, paths] : named_inputs_)
    for (const NamedPath& named : paths) refuse_changed(named.path);
  inputs_at_start_ = input_hashes(out_);
}

void Stage::publish() {
  // Everything that needs disk space comes first; the steps after that only remove and rename.
  refuse_changed_inputs();  // a record must name the inputs that were really read
  const std::string text = record_of(inputs_at_start_.value(), "", summary_);
  const fs::path record_name = spec_.name + ".yaml", timings_name = spec_.name + ".timings.yaml";
  write_file(partial_path(record_name), text);
  write_file(partial_path(timings_name), timings());
  std::vector<fs::path> written{partial_ / record_name};
  std::set<fs::path> folders{out_};
  for (const Output& output : outputs_) {
    written.push_back(partial_ / output.name);
    folders.insert((out_ / output.name).parent_path());
    fs::create_directories((out_ / output.name).parent_path());
  }
  flush_to_disk(written);
  std::set<std::string> leftovers;
  if (spec_.keeps_old_until_done) {
    // From here to the end there is no record, so that a mixture of old and new files never counts. Files of both runs
    // are never missing; files of the old run alone are removed once the new ones are in place.
    retire_old_record();
    leftovers = old_outputs();
  }
  const auto is_part = [&](const std::string& name) { return std::ranges::find(parts_, name) != parts_.end(); };
  for (const Output& output : outputs_) {
    if (!is_part(output.name)) fs::rename(partial_ / output.name, out_ / output.name);
    leftovers.erase(output.name);
  }
  for (const std::string& name : leftovers) remove_output(name);
  fs::rename(partial_ / timings_name, out_ / timings_name);
  // The record also reaches the disk last, and before a later stage acts on it (drop removes samples).
  flush_to_disk({folders.begin(), folders.end()});
  for (const std::string& part : parts_) fs::rename(partial_ / part, out_ / part);
  if (!parts_.empty()) flush_to_disk({folders.begin(), folders.end()});
  fs::rename(partial_ / record_name, out_ / record_name);
  flush_to_disk({out_});
  if (spec_.keeps_old_until_done) remove_quietly(out_ / (kReplacing + spec_.name));
}

void Stage::clean_up(int code) noexcept {
  try {
    if (code != 0 && !spec_.keeps_old_until_done) remove_quietly(out_ / (spec_.name + ".yaml"));
    if (code == 1 && spec_.resumable) {
      // Without the hashes the stage has not begun, and results of an earlier run may still be valid.
      if (!inputs_at_start_) return;
      if (keep_scratch_alone()) return;
    }
  } catch (const std::exception&) {
    // An input can no longer be read, so that results from it cannot be trusted.
  }
  remove_quietly(partial_);
}

void Stage::write_failure(const std::exception& error) const noexcept {
  try {
    Value::Map failure{{"stage", spec_.name}, {"version", program_version()}};
    add_notes(failure);
    failure.emplace_back("message", printable(reason_of(error)));
    if (const auto* verdict = dynamic_cast<const VerdictError*>(&error)) {
      const Miss& miss = verdict->miss();
      failure.emplace_back("frame", miss.frame);
      failure.emplace_back("check", miss.check);
      failure.emplace_back("value", miss.value);
      failure.emplace_back("limit", miss.limit);
    }
    const fs::path beside = out_ / (".failed-" + spec_.name);
    write_file(beside, to_yaml(failure));
    fs::rename(beside, out_ / (spec_.name + ".failed.yaml"));
  } catch (const std::exception&) {
    // The message has been logged; a full disk must not hide it behind a second one.
  }
}

int Stage::run(const std::function<void(Stage&)>& body) {
  int code = 1;
  try {
    begin();
    body(*this);
    publish();
    code = 0;
  } catch (const ConfigError& error) {
    log_error(error.what());
    code = 2;
  } catch (const UsageError& error) {
    log_error(fmt::format("{}: error: {}", spec_.name, error.what()));
    code = 2;
  } catch (const std::bad_alloc&) {
    log_error(fmt::format("{}: error: {}", spec_.name, kOutOfMemory));
    write_failure(std::runtime_error(kOutOfMemory));
  } catch (const std::exception& error) {
    log_error(fmt::format("{}: error: {}", spec_.name, reason_of(error)));
    write_failure(error);
  }
  clean_up(code);
  std::error_code ignored;
  if (code != 0 && spec_.keeps_old_until_done && fs::exists(out_ / (spec_.name + ".yaml"), ignored))
    log_warning("{} stays as it was before", out_.string());
  return code;
}

}  // namespace tacipc
