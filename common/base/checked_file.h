// Files written atomically: a killed program leaves the old one or the new one, and half of neither.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace tacipc {

/// Writes the bytes behind a line with their length and XXH3 checksum into a file beside, then renames it into place:
/// a process that dies meanwhile leaves the old file or none. \throw DataError if it cannot be written.
void write_checked_file(const std::filesystem::path& path, std::string_view bytes);

/// The bytes that write_checked_file was given; nothing if there is no such file, or it is not whole.
std::optional<std::string> read_checked_file(const std::filesystem::path& path);

/// Makes `path` hold the text, whole or not at all even after a power failure; a file that holds it already keeps its
/// time. Returns whether it wrote. \throw DataError if it cannot be written.
bool replace_if_changed(const std::filesystem::path& path, const std::string& text);

}  // namespace tacipc
