// Files that a killed program may leave behind: written atomically, read back only if whole.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace tacipc {

/// Writes the bytes behind a line with their length and XXH3 checksum into a file beside, then renames it into place:
/// whoever dies on the way leaves the old file or none. \throw DataError if it cannot be written.
void write_checked_file(const std::filesystem::path& path, std::string_view bytes);

/// The bytes that write_checked_file was given; nothing if there is no such file, or it is not whole.
std::optional<std::string> read_checked_file(const std::filesystem::path& path);

}  // namespace tacipc
