// The packed shards of a dataset: a text file that lists their records (docs/files.md, shards.txt).
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace tacipc {

/// Reads the lines of a text file as paths, relative to its folder. Thousands of shards would not fit on a command
/// line.
/// \throw DataError if the file lists nothing, or a file that does not exist
std::vector<std::filesystem::path> listed_records(const std::filesystem::path& list);

/// Names files in shard folders as records do: `shards/<shard>`.
std::vector<std::pair<std::string, std::filesystem::path>> named_by_shard(
    const std::vector<std::filesystem::path>& files);
/// Returns the HDF5 files of a list with these names.
std::vector<std::pair<std::string, std::filesystem::path>> listed_shards(const std::filesystem::path& list);

}  // namespace tacipc
