// Whole files in and out, with errors that name the file and the reason the system gave.
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace tacipc {

/// The bytes of a file. \throw DataError naming the file and why it cannot be read.
std::string read_file(const std::filesystem::path& path);

/// The bytes of a file in parts of at most 64 KiB, for files that need not fit into memory. \throw DataError as
/// read_file
void for_each_part(const std::filesystem::path& path, const std::function<void(std::string_view)>& use);

/// Writes a whole file, creating its folder. \throw DataError (no space, not writable, …); a file left behind then is
/// incomplete.
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// Waits until the bytes of files, or the names in folders, are on the disk: a name given after that (rename) is never
/// empty after a power failure. On file systems without this it does nothing. \throw DataError naming the path that
/// could not be written
void flush_to_disk(const std::vector<std::filesystem::path>& paths);

/// Content hash as 32 hex digits (XXH3, 128 bit). Of a folder: over the names and contents of its regular files in name
/// order, leaving out logs, timings and hidden names, so that it changes exactly when a result in it does. `without`:
/// files of it that do not count.
std::string content_hash(const std::filesystem::path& path, const std::set<std::filesystem::path>& without = {});

/// The longest folder that holds all files: names further up tell nothing about them.
std::filesystem::path common_folder(const std::vector<std::filesystem::path>& files);

}  // namespace tacipc
