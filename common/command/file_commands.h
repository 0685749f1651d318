// What scripts ask of records, configurations and tables, by name: `tacipc get`, `set`, `table`, `paths`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tacipc {

/// A command of the program tacipc that is no stage. `arguments` are those behind its name. It prints on standard
/// output; the exit code is 0 done, 1 not there or not readable, 2 wrong arguments or configuration.
struct FileCommand {
  const char* name;
  const char* summary;
  int (*run)(const std::vector<std::string>& arguments);
};

/// In the order in which they are listed. Their flags are all in one unit, for reading CLI11 takes a compiler seconds.
const std::vector<FileCommand>& file_commands();

/// What `tacipc get` is asked for.
struct GetRequest {
  std::string file;                     // record or configuration
  std::vector<std::string> keys;        // paths to values
  std::optional<std::string> fallback;  // printed for what is not there
  bool only_keys = false;               // a map's keys instead of what they hold
  std::vector<std::string> fields;      // of a list of maps: these of each
};

/// The lines to print. \throw DataError a key is not there and has no fallback
std::string get_values(const GetRequest& request);

/// A configuration with changes KEY=VALUE, +KEY=VALUE, -KEY made. \throw ConfigError, UsageError
std::string changed_configuration(const std::filesystem::path& file, const std::vector<std::string>& changes);

/// What `tacipc table` is asked for.
struct TableRequest {
  std::string file;                     // CSV
  std::vector<std::string> columns;     // empty: all
  std::vector<std::string> conditions;  // COLUMN=VALUE
  bool only_count = false;
};

/// Prints rows as they are read: a table may be larger than memory. \throw DataError, UsageError
void print_table(const TableRequest& request);

/// Files that the paths of a motion name, as seen from here.
std::vector<std::filesystem::path> files_of_motion(const std::filesystem::path& motion);

}  // namespace tacipc
