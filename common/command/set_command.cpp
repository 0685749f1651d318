#include <fmt/core.h>

#include <filesystem>

#include "common/base/error.h"
#include "common/base/files.h"
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

std::string changed_configuration(const std::filesystem::path& file, const std::vector<std::string>& changes) {
  ConfigText text(read_file(file), file.lexically_normal().string());
  std::vector<std::string> faults;
  for (const std::string& change : changes) {
    try {
      apply(text, change);
    } catch (const ConfigError& error) {
      faults.insert(faults.end(), error.faults().begin(), error.faults().end());
    }
  }
  if (!faults.empty()) throw ConfigError(faults);
  return text.text();
}

}  // namespace tacipc
