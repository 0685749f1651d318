// Files of the shared data, named `shared:data/…` in cases.
#pragma once

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace tacipc::verify {

constexpr std::string_view kSharedPrefix = "shared:";

/// True if a path names a file of the shared data.
inline bool is_shared(const std::string& path) { return path.starts_with(kSharedPrefix); }

/// Path of a file: `shared:rest` becomes `rest` in the shared folder; other paths stay.
inline std::filesystem::path resolve(const std::string& path, const std::filesystem::path& shared) {
  return is_shared(path) ? shared / path.substr(kSharedPrefix.size()) : std::filesystem::path(path);
}

/// Reason for skipping a case that needs this file: the shared folder does not exist.
inline std::optional<std::string> why_skipped(const std::string& path, const std::filesystem::path& shared) {
  if (!is_shared(path) || std::filesystem::exists(shared)) return std::nullopt;
  return fmt::format("needs {}; there is no folder {} (set TACIPC_SHARED)", path.substr(kSharedPrefix.size()),
                     shared.string());
}

/// Shared folder: $TACIPC_SHARED, otherwise ../shared next to the current folder.
inline std::filesystem::path shared_folder() {
  const char* set = std::getenv("TACIPC_SHARED");
  return set && *set ? std::filesystem::path(set) : std::filesystem::path("../shared");
}

}  // namespace tacipc::verify
