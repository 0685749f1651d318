// The behaviour every stage shares: flags, exit codes, atomic outputs, the record, the log.
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
  bool many = false;   // may be given several times
  bool named = false;  // each as NAME=PATH: the stage is told which is which, and need not guess it from the path

  static InputSpec optional(const char* flag, const char* help) { return {flag, help, false}; }
  static InputSpec several(const char* flag, const char* help) { return {flag, help, true, true}; }
  static InputSpec any_number(const char* flag, const char* help) { return {flag, help, false, true}; }
  static InputSpec several_named(const char* flag, const char* help) { return {flag, help, true, true, true}; }
  static InputSpec any_number_named(const char* flag, const char* help) { return {flag, help, false, true, true}; }
};

/// A flag that carries a word rather than a file (a sample's name), or none; tuning belongs into configuration.
struct OptionSpec {
  std::string flag;
  std::string help;
  std::string fallback = {};
  bool is_switch = false;  // takes no word; given, its word is `true`
};

struct StageSpec {
  std::string name;
  std::string summary;
  std::vector<InputSpec> inputs;
  std::vector<OptionSpec> options = {};
  bool resumable = false;  // scratch files of a run that was killed or failed are there again in the next equal one
  // Others need the earlier result while a new one is made, and it may be all there is where the new one is refused:
  // old record and outputs stay until the new ones are whole, and stay when the run fails.
  bool keeps_old_until_done = false;
  bool works_in_child = false;  // a library that it calls crashes on some damaged files (base/fragile_library.h)
};

/// A stage's access to flags, inputs and outputs.
class Stage {
 public:
  Stage(const StageSpec& spec, std::filesystem::path out, int threads);

  /// Path given to a flag; noted in the record with its content hash. \pre the flag is required.
  const std::filesystem::path& input(const std::string& flag) const;
  std::optional<std::filesystem::path> optional_input(const std::string& flag) const;
  const std::vector<std::filesystem::path>& inputs(const std::string& flag) const;
  /// Of a flag whose paths have names, in the order given.
  const std::vector<NamedPath>& named_inputs(const std::string& flag) const;
  const std::string& option(const std::string& flag) const;

  /// A file that no flag names but a configuration does: from here on an input like the others.
  void add_input(const std::string& name, const std::filesystem::path& path);
  void add_inputs(const std::vector<std::pair<std::string, std::filesystem::path>>& named);

  /// Reads a configuration file; every value of it goes into the record under `config`.
  template <typename T>
  T read_config(const std::string& flag) {
    ConfigReader in = ConfigReader::from_file(input(flag));
    T config = T::read(in);
    in.finish();
    note_config(flag, in.resolved());
    return config;
  }

  /// Where to write an output of this name. It appears under --out only when the whole stage has succeeded.
  std::filesystem::path output(const std::string& name);
  /// The same for outputs that differ between runs, such as times: the record names the file without a hash.
  std::filesystem::path varying_output(const std::string& name);
  /// An output that is a file of another stage's, under a hard link (copied where the file system has none). `hash` is
  /// the one in that stage's record, so that large files need not be read again.
  void link_output(const std::string& name, const std::filesystem::path& file, const std::string& hash);
  /// Removes the old record of a stage that keeps its old results, which publishing would do in any case. For a body
  /// that is about to change files beside its outputs: killed there, it must not leave a record that they do not fit.
  void retire_old_record();
  /// Folder the outputs end in (for relative links).
  const std::filesystem::path& out() const { return out_; }

  /// A file that is never published. It goes when the stage has succeeded; that of a resumable stage survives a run
  /// that was killed or failed, until one begins with another program, instruction set, input or option.
  std::filesystem::path scratch(const std::string& name) const;
  /// Saves bytes in a scratch file, whole or not at all. \throw DataError if an input has changed since the start:
  /// what was computed might not belong to it.
  void save_scratch(const std::string& name, std::string_view bytes);
  /// What save_scratch saved, in this run or an equal earlier one; nothing if there is none or it is damaged.
  std::optional<std::string> load_scratch(const std::string& name) const;

  /// Ends a part of the result that others read as a result of its own, in a folder below --out: writes a record there,
  /// of the outputs so far whose names begin with `folder`/, with the same inputs and configuration and this summary.
  void finish_part(const std::string& folder, const Value::Map& summary);

  /// Adds to the record: a top-level entry (`sample: star`) or lines of its summary.
  void note(const std::string& key, Value value);
  void summarize(const Value::Map& lines);

  /// Adds lines to what the run cost (below).
  void cost(const Value::Map& lines);

  /// Threads the stage may use; already in force for oneTBB.
  int threads() const { return threads_; }

 private:
  friend int run_stage(const StageSpec&, int, char**, const std::function<void(Stage&)>&);
  /// run_stage, once the program runs as it should.
  static int run_here(const StageSpec& spec, int argc, char** argv, const std::function<void(Stage&)>& body);
  std::filesystem::path partial_path(const std::string& name) const;
  void note_config(const std::string& flag, Value config);
  /// The whole life of a stage under the lock of its folder. Returns the exit code.
  int run(const std::function<void(Stage&)>& body);
  void begin();
  /// Whether the record in the output folder is of these very inputs and options, unchanged.
  bool is_done() const;
  /// Keeps the scratch files of an equal earlier run, or none. Before the first file is written or looked for, but not
  /// earlier: until all inputs are added no run is equal to an earlier one.
  void open_scratch() const;
  /// Removes unfinished outputs, if there are scratch files of the same inputs to keep. Returns whether there are.
  bool keep_scratch_alone() const;
  void publish();
  void clean_up(int code) noexcept;
  void write_failure(const std::exception& error) const noexcept;
  void remove_old_results() const;
  void remove_output(const std::string& name) const;
  /// Outputs of earlier runs, as their record lists them or, where one was killed while publishing, the list it left
  /// for that.
  std::set<std::string> old_outputs() const;
  /// With paths as seen from a folder.
  Value input_hashes(const std::filesystem::path& from) const;
  bool inputs_changed() const;
  /// \throw DataError if inputs_changed()
  void refuse_changed_inputs() const;
  /// \throw DataError if a record vouches for another content of an input (vouched.h)
  void refuse_changed(const std::filesystem::path& input) const;
  /// What scratch files depend on, as text.
  std::string resume_key() const;
  /// Notes and options, as record and failure file repeat them.
  void add_notes(Value::Map& record) const;
  /// The record of the outputs in a folder: their names begin with `prefix`.
  std::string record_of(const Value& inputs, const std::string& prefix, const Value::Map& summary) const;
  /// Text of `<stage>.timings.yaml`: wall and processor time, peak memory and the stage's own lines. Not part of the
  /// record, as no two runs agree in it.
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
    std::optional<std::string> hash = std::nullopt;  // absent: of the file when all is done
  };
  std::vector<Output> outputs_;
  std::vector<std::string> parts_;  // the outputs that are records of parts
  std::optional<Value> inputs_at_start_;
  bool scratch_belongs_to_inputs_ = false;
  mutable bool scratch_is_open_ = false;
  Value::Map configs_;
  Value::Map notes_;
  Value::Map summary_;
  Value::Map cost_;
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
};

/// Runs one stage: parses flags, removes the old record (of one that keeps old results after the body), calls `body`,
/// moves outputs into place, writes the record last. Returns the exit code: 0 done, 1 the work failed, 2 wrong flags or
/// configuration; 3 nothing had to be done, as --if-changed asks. Work that failed leaves `<stage>.failed.yaml` with
/// the reason, which the next start removes. A crash in a child process is work that failed.
int run_stage(const StageSpec& spec, int argc, char** argv, const std::function<void(Stage&)>& body);

/// Version of the program, from git when it was built.
std::string program_version();

}  // namespace tacipc
