// Tables of a shard: one row per sample, and one per failure.
#pragma once

#include <string>
#include <vector>

#include "common/sample/dataset_plan.h"
#include "stages/dataset/pack/sample_frames.h"

namespace tacipc {

std::vector<std::string> manifest_columns();
/// Row of a sample in its shard; `offset` is its position there, from 0.
std::vector<std::string> manifest_row(const PlannedRow& plan, const std::string& sensor_id, std::size_t offset,
                                      const SampleFrames& sample);
/// Row of a sample that is not in the shard: its status, and empty fields for everything that only a made sample has.
std::vector<std::string> manifest_row(const PlannedRow& plan, const Failure& failure);

std::vector<std::string> failure_columns();
std::vector<std::string> failure_row(const PlannedRow& plan, const Failure& failure);

std::vector<std::string> timing_columns();
/// Row with seconds and megabytes of both stages; empty fields for a stage without timings.
std::vector<std::string> timing_row(const std::string& id, const std::filesystem::path& sample_folder);

}  // namespace tacipc
