#include <fmt/core.h>

#include <filesystem>

#include "common/command/command_run.h"
#include "common/command/file_commands.h"
#include "common/config/config.h"

namespace tacipc {

int paths_command(const std::vector<std::string>& arguments) {
  CLI::App app("Prints the files that the paths of a motion name, one line each, as seen from here.");
  std::filesystem::path file;
  app.add_option("file", file, "the motion (YAML)")->required()->type_name("MOTION.yaml");
  return run_command("paths", app, arguments, [&] {
    ConfigReader in = ConfigReader::from_file(file);
    for (ConfigReader& phase : in.one_or_more_sections("motion")) {
      if (const auto name = phase.optional_text("file")) fmt::print("{}\n", (file.parent_path() / *name).string());
    }
  });
}

}  // namespace tacipc
