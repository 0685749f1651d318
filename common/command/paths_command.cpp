#include <filesystem>

#include "common/command/file_commands.h"
#include "common/config/config.h"

namespace tacipc {

std::vector<std::filesystem::path> files_of_motion(const std::filesystem::path& motion) {
  std::vector<std::filesystem::path> files;
  ConfigReader in = ConfigReader::from_file(motion);
  for (ConfigReader& phase : in.one_or_more_sections("motion")) {
    if (const auto name = phase.optional_text("file")) files.push_back(motion.parent_path() / *name);
  }
  return files;
}

}  // namespace tacipc
