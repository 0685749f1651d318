// The manners every stage shares: flags, exit codes, atomic outputs, the record, the log.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/config.h"
#include "common/value.h"

namespace tacipc {

/// A flag that names a file or folder the stage reads.
struct InputSpec {
  std::string flag;  // "--mesh"
  std::string help;
  bool required = true;
  bool many = false;  // may be given several times
};

/// A flag that carries a word rather than a file (a sample's name); tuning belongs into configuration.
struct OptionSpec {
  std::string flag;
  std::string help;
  std::string fallback;
};

struct StageSpec {
  std::string name;
  std::string summary;
  std::vector<InputSpec> inputs;
  std::vector<OptionSpec> options = {};
};

/// What a stage's body sees of the outside.
class Stage {
 public:
  Stage(const StageSpec& spec, std::filesystem::path out, int threads);

  /// Path given to a flag; noted in the record with its content hash. \pre the flag is required.
  const std::filesystem::path& input(const std::string& flag) const;
  std::optional<std::filesystem::path> optional_input(const std::string& flag) const;
  const std::vector<std::filesystem::path>& inputs(const std::string& flag) const;
  const std::string& option(const std::string& flag) const;

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
  /// Folder the outputs end in (for relative links).
  const std::filesystem::path& out() const { return out_; }

  /// Adds to the record: a top-level entry (`sample: star`) or lines of its summary.
  void note(const std::string& key, Value value);
  void summarize(const Value::Map& lines);

  /// Threads the stage may use; already in force for oneTBB.
  int threads() const { return threads_; }

 private:
  friend int run_stage(const StageSpec&, int, char**, const std::function<void(Stage&)>&);
  void note_config(const std::string& flag, Value config);
  Value input_hashes() const;
  std::string record() const;
  void remove_old_results() const;
  void publish();

  const StageSpec& spec_;
  std::filesystem::path out_;
  std::filesystem::path partial_;
  int threads_;
  std::map<std::string, std::vector<std::filesystem::path>> inputs_;
  std::map<std::string, std::string> options_;
  std::vector<std::string> outputs_;
  Value inputs_at_start_;
  Value::Map configs_;
  Value::Map notes_;
  Value::Map summary_;
};

/// Runs one stage: parses flags, removes the old record, calls `body`, moves outputs into place, writes the record
/// last. Returns the exit code: 0 done, 1 the work failed, 2 wrong flags or configuration.
int run_stage(const StageSpec& spec, int argc, char** argv, const std::function<void(Stage&)>& body);

/// Version of the program, from git when it was built.
std::string program_version();

}  // namespace tacipc
