// Commands for scripts on records, configurations and tables: `tacipc get`, `set`, `table`, `paths`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tacipc {

/// A command of the program tacipc that is not a stage. It takes the arguments after its name, prints on standard
/// output, and returns an exit code: 0 done, 1 missing or unreadable, 2 wrong arguments or configuration.
struct FileCommand {
  const char* name;
  const char* summary;
  int (*run)(const std::vector<std::string>& arguments);
};

/// Returns the commands in the order in which they are listed. All flags are parsed in one unit, because compiling
/// CLI11 takes seconds.
const std::vector<FileCommand>& file_commands();

/// Arguments of `tacipc get`.
struct GetRequest {
  std::string file;                     // record or configuration
  std::vector<std::string> keys;        // paths to values
  std::optional<std::string> fallback;  // printed for missing values
  bool only_keys = false;               // print the keys of a map instead of its values
  std::vector<std::string> fields;      // fields to print from each map of a list
};

/// Returns the lines to print.
/// \throw DataError if a key is missing and there is no fallback
std::string get_values(const GetRequest& request);

/// Returns a configuration after changes KEY=VALUE, +KEY=VALUE, -KEY.
/// \throw ConfigError if a key is missing or misplaced
/// \throw UsageError if a change has no valid form
std::string changed_configuration(const std::filesystem::path& file, const std::vector<std::string>& changes);

/// Arguments of `tacipc table`.
struct TableRequest {
  std::string file;                     // CSV
  std::vector<std::string> columns;     // empty: all
  std::vector<std::string> conditions;  // COLUMN=VALUE
  bool only_count = false;
};

/// Prints rows while reading them: a table may be larger than memory.
/// \throw DataError if the table cannot be read
/// \throw UsageError if an argument is not valid
void print_table(const TableRequest& request);

/// Returns the files that the paths of a motion name, relative to the working directory.
std::vector<std::filesystem::path> files_of_motion(const std::filesystem::path& motion);

}  // namespace tacipc
