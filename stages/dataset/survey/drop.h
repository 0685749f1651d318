// Removes files that stages wrote for packed samples.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace tacipc {

/// Result of drop_packed.
struct Dropped {
  std::size_t stages = 0;  // number of stages whose files were removed
  std::size_t samples =
      0;  // Removes the files of `stages`, except their records, timings and logs: a sample stays made. Only samples
          // that the manifest of the pack lists as made are touched. Their records must still have the hashes of the
          // manifest, and nobody may be making them. \param whole_shards only drop samples in shards in which no sample
          // failed, because a shard with a failed sample is packed again when that sample is made later \throw
          // DataError if the dataset is not packed, or its manifest has no hashes
};

/// Removes the files of `stages`, except their records, timings and logs: a sample stays made. Only samples that the
/// manifest of the pack lists as made are touched. Their records must still have the hashes of the manifest, and nobody
/// may be making them.
/// \param whole_shards only drop samples in shards in which no sample failed, because a shard
/// with a failed sample is packed again when that sample is made later
/// \throw DataError if the dataset is not packed, or its manifest has no hashes
Dropped drop_packed(const std::filesystem::path& dataset, const std::vector<std::string>& stages, bool whole_shards);

}  // namespace tacipc
