// The packed shards of a dataset: a text file that names their records (docs/files.md, shards.txt).
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace tacipc {

/// The lines of a text file as paths, relative ones from its folder on. Thousands of shards are more than a command
/// line takes. \throw DataError if it names none, or a file that is not there
std::vector<std::filesystem::path> listed_records(const std::filesystem::path& list);

/// Files in the folders of shards, each under the name that records have for it: `shards/<shard>`.
std::vector<std::pair<std::string, std::filesystem::path>> named_by_shard(
    const std::vector<std::filesystem::path>& files);
/// The HDF5 files of a list, so named.
std::vector<std::pair<std::string, std::filesystem::path>> listed_shards(const std::filesystem::path& list);

}  // namespace tacipc
