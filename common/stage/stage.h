// Stage: common behaviour of all stages (flags, exit codes, atomic outputs, record, log).
#pragma once

#include <chrono>
#include <exception>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/base/value.h"
#include "common/config/config.h"
#include "common/stage/named_path.h"

namespace tacipc {

/// A flag that names a file or folder the stage reads.
struct InputSpec {
  std::string flag;  // "--mesh"
  std::string help;
  bool required = true;
  bool many = false;   // the flag may be given several times
  bool named = false;  // each path has a name, NAME=PATH, which identifies its role

  // Shorthands for the combinations of required, many and named.
  static InputSpec optional(const char* flag, const char* help) { return {flag, help, false}; }
  static InputSpec several(const char* flag, const char* help) { return {flag, help, true, true}; }
  static InputSpec any_number(const char* flag, const char* help) { return {flag, help, false, true}; }
  static InputSpec several_named(const char* flag, const char* help) { return {flag, help, true, true, true}; }
  static InputSpec any_number_named(const char* flag, const char* help) { return {flag, help, false, true, true}; }
};

/// A flag with a text value (such as a sample's name), or a switch. Tuning belongs into a configuration file.
struct OptionSpec {
  std::string flag;
  std::string help;
  std::string fallback = {};
  bool is_switch = false;  // takes no value; if given, its value is `true`
};

/// Declaration of a stage.
struct StageSpec {
  std::string name;
  std::string summary;
  std::vector<InputSpec> inputs;
  std::vector<OptionSpec> options = {};
  bool resumable = false;  // scratch files of a killed or failed run remain for the next run with equal inputs
  // Other programs use the earlier result while a new one is made, and it must survive if the new one is refused: old
  // record and outputs stay until the new ones are complete, and stay if the run fails.
  bool keeps_old_until_done = false;
  bool works_in_child = false;  // run in a child process: a library crashes on damaged files (base/fragile_library.h)
};

/// A running stage: access to flags, inputs and outputs.
class Stage {
 public:
  /// \param out folder of the outputs
  /// \param threads number of threads the stage may use
  Stage(const StageSpec& spec, std::filesystem::path out, int threads);

  /// Returns the path given to a flag; the record stores it with its content hash.
  /// \pre the flag is required
  const std::filesystem::path& input(const std::string& flag) const;
  /// Returns the path given to an optional flag; nothing if it is absent.
  std::optional<std::filesystem::path> optional_input(const std::string& flag) const;
  /// Returns all paths given to a flag.
  const std::vector<std::filesystem::path>& inputs(const std::string& flag) const;
  /// Returns the paths of a flag whose paths have names, in the order given.
  const std::vector<NamedPath>& named_inputs(const std::string& flag) const;
  /// Returns the value of an option.
  const std::string& option(const std::string& flag) const;

  /// Adds an input file that a configuration names instead of a flag.
  void add_input(const std::string& name, const std::filesystem::path& path);
  /// Adds several such files.
  void add_inputs(const std::vector<std::pair<std::string, std::filesystem::path>>& named);

  /// Reads a configuration file; all its values are stored in the record under `config`.
  template <typename T>
  T read_config(const std::string& flag) {
    ConfigReader in = ConfigReader::from_file(input(flag));
    T config = T::read(in);
    in.finish();
    note_config(flag, in.resolved());
    return config;
  }

  /// Returns the path at which to write an output. The file appears under --out only after the whole stage succeeded.
  std::filesystem::path output(const std::string& name);
  /// Returns the path of an output that differs between runs, such as times: the record lists the file without a hash.
  std::filesystem::path varying_output(const std::string& name);
  /// Adds an output that is another stage's file, as a hard link (a copy if the file system has no links).
  /// \param hash hash in the other stage's record, so that large files need not be read again
  void link_output(const std::string& name, const std::filesystem::path& file, const std::string& hash);
  /// Removes the old record of a stage that keeps its old results, as publishing does. For a body that is about to
  /// change files next to its outputs: if it is killed then, no record may remain that does not fit them.
  void retire_old_record();
  /// Returns the folder of the published outputs (for relative links).
  const std::filesystem::path& out() const { return out_; }

  /// Returns the path of a file that is never published. It is removed when the stage succeeds. Scratch files of a
  /// resumable stage survive a killed or failed run, until a run begins with another program, instruction set, input or
  /// option.
  std::filesystem::path scratch(const std::string& name) const;
  /// Saves bytes in a scratch file, completely or not at all.
  /// \throw DataError if an input has changed since the start, so that the result might not belong to it
  void save_scratch(const std::string& name, std::string_view bytes);
  /// Returns the bytes that save_scratch() saved, in this run or an equal earlier one; nothing if there are none or
  /// they are damaged.
  std::optional<std::string> load_scratch(const std::string& name) const;

  /// Finishes a part of the result that others read as a result of its own, in a folder below --out: writes a record
  /// there, for the outputs so far whose names begin with `folder`/, with the same inputs and configuration and this
  /// summary.
  void finish_part(const std::string& folder, const Value::Map& summary);

  /// Adds a top-level entry to the record (`sample: star`).
  void note(const std::string& key, Value value);
  /// Adds lines to the record's summary.
  void summarize(const Value::Map& lines);

  /// Adds lines to the timings file.
  void cost(const Value::Map& lines);

  /// Returns the number of threads that the stage may use; oneTBB already obeys it.
  int threads() const { return threads_; }

 private:
  friend int run_stage(const StageSpec&, int, char**, const std::function<void(Stage&)>&);
  /// Does the work of run_stage() once OpenBLAS and the child process are set up.
  static int run_here(const StageSpec& spec, int argc, char** argv, const std::function<void(Stage&)>& body);
  std::filesystem::path partial_path(const std::string& name) const;
  void note_config(const std::string& flag, Value config);
  /// Runs the whole stage under the lock of its folder. Returns the exit code.
  int run(const std::function<void(Stage&)>& body);
  void begin();
  /// Returns whether the record in the output folder has the same inputs and options, with unchanged contents.
  bool is_done() const;
  /// Keeps the scratch files of an equal earlier run and removes others. Runs before the first file is written or
  /// looked for, but not earlier: until all inputs are added, runs cannot be compared.
  void open_scratch() const;
  /// Removes unfinished outputs if there are scratch files of the same inputs to keep. Returns whether there are.
  bool keep_scratch_alone() const;
  void publish();
  void clean_up(int code) noexcept;
  void write_failure(const std::exception& error) const noexcept;
  void remove_old_results() const;
  void remove_output(const std::string& name) const;
  /// Returns the outputs of earlier runs, as their record lists them, or as the list that a killed run left while
  /// publishing.
  std::set<std::string> old_outputs() const;
  /// Returns hashes of the inputs, with paths relative to a folder.
  Value input_hashes(const std::filesystem::path& from) const;
  bool inputs_changed() const;
  /// Refuses inputs that have changed.
  /// \throw DataError if inputs_changed()
  void refuse_changed_inputs() const;
  /// Refuses an input that does not match its record (vouched.h).
  /// \throw DataError if a record lists another hash of it
  void refuse_changed(const std::filesystem::path& input) const;
  /// Returns everything on which scratch files depend, as text.
  std::string resume_key() const;
  /// Adds notes and options, as record and failure file store them.
  void add_notes(Value::Map& record) const;
  /// Returns the text of the record for outputs whose names begin with `prefix`.
  std::string record_of(const Value& inputs, const std::string& prefix, const Value::Map& summary) const;
  /// Returns the text of `<stage>.timings.yaml`: wall and processor time, peak memory and the stage's own lines. They
  /// are not part of the record, because they differ between runs.
  std::string timings() const;

  const StageSpec& spec_;
  std::filesystem::path out_;
  std::filesystem::path partial_;
  int threads_;
  std::map<std::string, std::vector<std::filesystem::path>> inputs_;
  std::map<std::string, std::vector<NamedPath>> named_inputs_;
  std::vector<std::pair<std::string, std::filesystem::path>> added_inputs_;
  std::map<std::string, std::string> options_;
  struct Output {
    std::string name;
    std::optional<std::string> hash = std::nullopt;  // absent: computed from the file at the end
  };
  std::vector<Output> outputs_;
  std::vector<std::string> parts_;  // outputs that are records of parts
  std::optional<Value> inputs_at_start_;
  bool scratch_belongs_to_inputs_ = false;
  mutable bool scratch_is_open_ = false;
  Value::Map configs_;
  Value::Map notes_;
  Value::Map summary_;
  Value::Map cost_;
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
};

/// Runs one stage: parses flags, removes the old record (after the body, if the stage keeps old results), calls `body`,
/// moves outputs into place, and writes the record last. Failed work leaves `<stage>.failed.yaml` with the reason,
/// which the next start removes. A crash of the child process counts as failed work.
/// \return the exit code: 0 done, 1 the work failed, 2 wrong flags or configuration, 3 nothing to do (with
/// --if-changed)
int run_stage(const StageSpec& spec, int argc, char** argv, const std::function<void(Stage&)>& body);

/// Returns the version of the program, from git at build time.
std::string program_version();

}  // namespace tacipc
