// Writes files atomically: if the program is killed, the old or the new file remains, never a partial one.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace tacipc {

/// Writes bytes, after a line with their length and XXH3 checksum, to a file next to `path`, then renames it: if the
/// process dies meanwhile, the old file or none remains.
/// \throw DataError if the file cannot be written
void write_checked_file(const std::filesystem::path& path, std::string_view bytes);

/// Reads the bytes that write_checked_file() wrote; nothing if there is no such file or it is incomplete.
std::optional<std::string> read_checked_file(const std::filesystem::path& path);

/// Makes `path` hold the text, completely or not at all even after a power failure. A file that already holds it keeps
/// its modification time.
/// \return whether the file was written
/// \throw DataError if it cannot be written
bool replace_if_changed(const std::filesystem::path& path, const std::string& text);

}  // namespace tacipc
