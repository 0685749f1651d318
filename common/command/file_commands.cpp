#include "common/command/file_commands.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <functional>
#include <sstream>

#include "common/base/error.h"
#include "common/base/printable.h"
#include "common/stage/unchanged.h"

namespace tacipc {
namespace {

/// Parses the arguments and runs the body; messages begin with `tacipc <name>`. Returns the exit code.
int run_command(const std::string& name, CLI::App& app, const std::vector<std::string>& arguments,
                const std::function<void()>& body) {
  app.name("tacipc " + name);
  try {
    app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));  // CLI11 takes arguments from the back
    body();
    if (std::fflush(stdout) != 0) throw DataError("standard output cannot be written");
    return 0;
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    fmt::print(stderr, "tacipc {0}: error: {1} (see tacipc {0} --help)\n", name, printable(error.what()));
    return 2;
  } catch (const ConfigError& error) {
    fmt::print(stderr, "{}\n", printable(error.what()));
    return 2;
  } catch (const UsageError& error) {
    fmt::print(stderr, "tacipc {}: error: {}\n", name, printable(error.what()));
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "tacipc {}: error: {}\n", name, printable(error.what()));
    return 1;
  }
}

std::vector<std::string> names_of(const std::string& joined) {
  std::vector<std::string> names;
  std::istringstream in(joined);
  for (std::string name; std::getline(in, name, ',');) names.push_back(name);
  return names;
}

int get_command(const std::vector<std::string>& arguments) {
  CLI::App app("Prints values of a record or configuration (YAML), one line each; of a list one line per item.");
  GetRequest request;
  std::string fallback, joined_fields;
  app.add_option("file", request.file, "the record or configuration")->required()->type_name("FILE");
  app.add_option("key", request.keys, "keys that lead to a value, joined by points; items of lists as [0]")
      ->required()
      ->type_name("KEY");
  auto* has_fallback = app.add_option("--default", fallback, "printed for what is not there")->type_name("TEXT");
  app.add_flag("--keys", request.only_keys, "the keys of a map instead of what they hold");
  app.add_option("--fields", joined_fields,
                 "of a list of maps: these of each (a,b,c), a line for each, separated by tabs")
      ->type_name("NAMES")
      ->excludes("--keys");
  return run_command("get", app, arguments, [&] {
    if (*has_fallback) request.fallback = fallback;
    request.fields = names_of(joined_fields);
    fmt::print("{}", get_values(request));
  });
}

int set_command(const std::vector<std::string>& arguments) {
  CLI::App app(
      "Prints a configuration (YAML) with some of its values changed; layout and comments of the rest stay.\n"
      "  KEY=VALUE   changes a value that is there\n"
      "  +KEY=VALUE  adds a key that is not there\n"
      "  -KEY        takes a key out\n"
      "Keys are joined by points, items of lists are [0]; a value is YAML on one line.");
  std::string file;
  std::vector<std::string> changes;
  app.add_option("file", file, "the configuration")->required()->type_name("FILE");
  app.add_option("change", changes, "what to change")->type_name("CHANGE");
  std::vector<std::string> marked = arguments;
  // A change that removes a key begins with - but is not a flag.
  if (!marked.empty() && !marked.front().starts_with('-')) marked.insert(marked.begin() + 1, "--");
  return run_command("set", app, marked, [&] { fmt::print("{}", changed_configuration(file, changes)); });
}

int table_command(const std::vector<std::string>& arguments) {
  CLI::App app(
      "Prints rows of a table (CSV), fields separated by tabs; a tab or line break in a field becomes a blank.");
  TableRequest request;
  std::string names;
  app.add_option("file", request.file, "the table")->required()->type_name("FILE.csv");
  app.add_option("--columns", names, "columns to print, in this order, joined by commas (default: all)")
      ->type_name("NAMES");
  app.add_option("--where", request.conditions, "only rows with this value; may be given several times")
      ->expected(1)
      ->take_all()
      ->type_name("COLUMN=VALUE");
  app.add_flag("--count", request.only_count, "how many rows there are, instead of the rows");
  return run_command("table", app, arguments, [&] {
    request.columns = names_of(names);
    print_table(request);
  });
}

int paths_command(const std::vector<std::string>& arguments) {
  CLI::App app("Prints the files that the paths of a motion name, one line each, as seen from here.");
  std::string file;
  app.add_option("file", file, "the motion (YAML)")->required()->type_name("MOTION.yaml");
  return run_command("paths", app, arguments, [&] {
    for (const auto& path : files_of_motion(file)) fmt::print("{}\n", path.string());
  });
}

int unchanged_command(const std::vector<std::string>& arguments) {
  CLI::App app(
      "Exits with 0 if all that a finished stage read still has the content that its record names, and all that it "
      "wrote is there; else with 1.");
  std::string record;
  app.add_option("record", record, "the record")->required()->type_name("RECORD.yaml");
  bool unchanged = true;
  const int code = run_command("unchanged", app, arguments, [&] { unchanged = is_unchanged(record); });
  return code == 0 && !unchanged ? 1 : code;
}

}  // namespace

const std::vector<FileCommand>& file_commands() {
  static const std::vector<FileCommand> commands{
      {"get", "Values of a record or configuration, by key.", get_command},
      {"set", "A configuration with some of its values changed.", set_command},
      {"table", "Rows of a table, by names of columns.", table_command},
      {"paths", "Files that the paths of a motion name.", paths_command},
      {"unchanged", "Whether a result's inputs are what they were.", unchanged_command}};
  return commands;
}

}  // namespace tacipc
