#include "common/command/file_commands.h"

#include <fmt/core.h>

#include <cstdio>
#include <exception>
#include <sstream>

#include "common/base/error.h"
#include "common/command/command_run.h"

namespace tacipc {

const std::vector<FileCommand>& file_commands() {
  static const std::vector<FileCommand> commands{
      {"get", "Values of a record or configuration, by key.", get_command},
      {"set", "A configuration with some of its values changed.", set_command},
      {"table", "Rows of a table, by names of columns.", table_command},
      {"paths", "Files that the paths of a motion name.", paths_command}};
  return commands;
}

int run_command(const std::string& name, CLI::App& app, const std::vector<std::string>& arguments,
                const std::function<void()>& body) {
  app.name("tacipc " + name);
  try {
    app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));  // it takes them from the back
    body();
    if (std::fflush(stdout) != 0) throw DataError("standard output cannot be written");
    return 0;
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    fmt::print(stderr, "tacipc {0}: error: {1} (see tacipc {0} --help)\n", name, error.what());
    return 2;
  } catch (const ConfigError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  } catch (const UsageError& error) {
    fmt::print(stderr, "tacipc {}: error: {}\n", name, error.what());
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "tacipc {}: error: {}\n", name, error.what());
    return 1;
  }
}

std::vector<std::string> names_of(const std::string& joined) {
  std::vector<std::string> names;
  std::istringstream in(joined);
  for (std::string name; std::getline(in, name, ',');) names.push_back(name);
  return names;
}

}  // namespace tacipc
