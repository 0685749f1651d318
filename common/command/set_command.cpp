#include <fmt/core.h>

#include <filesystem>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/command/command_run.h"
#include "common/command/file_commands.h"
#include "common/config/config_text.h"

namespace tacipc {
namespace {

void apply(ConfigText& text, const std::string& change) {
  const bool adds = change.starts_with('+'), removes = change.starts_with('-');
  const std::string said = change.substr(adds || removes ? 1 : 0);
  const std::size_t equals = removes ? std::string::npos : said.find('=');
  const std::string key = said.substr(0, equals);
  if (key.empty() || (!removes && equals == std::string::npos))
    throw UsageError(fmt::format("'{}': say KEY=VALUE, +KEY=VALUE or -KEY", change));
  if (removes) return text.remove(key);
  const std::string value = said.substr(equals + 1);
  if (adds) return text.add(key, value);
  text.set(key, value);
}

}  // namespace

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
  // What takes a key out is no flag.
  if (!marked.empty() && !marked.front().starts_with('-')) marked.insert(marked.begin() + 1, "--");
  return run_command("set", app, marked, [&] {
    ConfigText text(read_file(file), std::filesystem::path(file).lexically_normal().string());
    std::vector<std::string> faults;
    for (const std::string& change : changes) {
      try {
        apply(text, change);
      } catch (const ConfigError& error) {
        faults.insert(faults.end(), error.faults().begin(), error.faults().end());
      }
    }
    if (!faults.empty()) throw ConfigError(faults);
    fmt::print("{}", text.text());
  });
}

}  // namespace tacipc
