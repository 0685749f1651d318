// Reads and writes whole files, with errors that name the file and the system's reason.
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace tacipc {

/// Returns the bytes of a file.
/// \throw DataError naming the file and the reason
std::string read_file(const std::filesystem::path& path);

/// Passes the bytes of a file to `use` in parts of at most 64 KiB, for files that need not fit into memory.
/// \throw DataError as read_file()
void for_each_part(const std::filesystem::path& path, const std::function<void(std::string_view)>& use);

/// Writes a whole file and creates its folder. After an error, a remaining file is incomplete.
/// \throw DataError (no space, not writable, …)
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// Waits until the bytes of files, or the names in folders, are on the disk, so that a file renamed after that is never
/// empty after a power failure. Does nothing on file systems without this function.
/// \throw DataError naming the path that could not be written
void flush_to_disk(const std::vector<std::filesystem::path>& paths);

/// Returns the content hash as 32 hex digits (XXH3, 128 bit). The hash of a folder covers names and contents of its
/// regular files in name order, except logs, timings and hidden names, so that it changes exactly when a result does.
/// \param without files of the folder to leave out
std::string content_hash(const std::filesystem::path& path, const std::set<std::filesystem::path>& without = {});

/// Returns the longest path of a folder that holds all files.
std::filesystem::path common_folder(const std::vector<std::filesystem::path>& files);

}  // namespace tacipc
