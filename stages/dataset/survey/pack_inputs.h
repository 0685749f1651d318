// Lists the inputs of each shard of a dataset.
#pragma once

#include <filesystem>

namespace tacipc {

/// Writes three kinds of files; a file with the same bytes is not rewritten.
/// - shards/<shard>.inputs, which changes when any input of that shard does
/// - shards.mk and shards.txt with the names of the shards
/// - dataset.yaml with the part of the dataset's configuration that all samples share. It excludes how a run ends or
/// when it stops, and the division into shards, which the rows of the plan contain.
/// For plan and profile the contents count, for records the times. Must be called by one process at a time.
/// \throw UsageError if the dataset or the profile does not exist
/// \throw DataError if the plan has no samples or is half replaced
void write_pack_inputs(const std::filesystem::path& dataset, const std::filesystem::path& profile);

}  // namespace tacipc
