// What each shard of a dataset is packed from.
#pragma once

#include <filesystem>

namespace tacipc {

/// Writes shards/<shard>.inputs, which changes when anything does that is packed into that shard; shards.mk and
/// shards.txt with the names of the shards; and dataset.yaml, what of the dataset's configuration all samples share:
/// not how a run ends or when it stops, nor how shards are divided, which the rows of the plan say. Of plan and profile
/// contents count, not times; of records their times do. A file that is there with the same bytes stays as it is. To be
/// called by one at a time. \throw UsageError if the dataset or the profile is not there, DataError if the plan has no
/// samples or is half replaced
void write_pack_inputs(const std::filesystem::path& dataset, const std::filesystem::path& profile);

}  // namespace tacipc
