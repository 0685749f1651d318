// Removing what stages wrote for samples that are packed.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace tacipc {

struct Dropped {
  std::size_t stages = 0;   // of which files were removed
  std::size_t samples = 0;  // that keep their files: not as they were packed, or being made
};

/// Removes what `stages` wrote, but their records, times and logs: a sample stays made. Only samples that the manifest
/// of the pack lists as made are touched, and only as they were packed: with the records whose hashes it has, and while
/// nobody makes them. With `whole_shards` only those in shards where no sample failed, as such a shard is packed again
/// when one is made after all. \throw DataError if the dataset is not packed, or its manifest has no hashes
Dropped drop_packed(const std::filesystem::path& dataset, const std::vector<std::string>& stages, bool whole_shards);

}  // namespace tacipc
