// What scripts ask of records, configurations and tables, by name: `tacipc get`, `set`, `table`, `paths`.
#pragma once

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

/// In the order in which they are listed.
const std::vector<FileCommand>& file_commands();

int get_command(const std::vector<std::string>& arguments);
int paths_command(const std::vector<std::string>& arguments);
int set_command(const std::vector<std::string>& arguments);
int table_command(const std::vector<std::string>& arguments);

}  // namespace tacipc
