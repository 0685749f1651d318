// What a shard tells of its samples in tables: one row each, and one per failure.
#pragma once

#include <string>
#include <vector>

#include "common/sample/dataset_plan.h"
#include "stages/dataset/pack/sample_frames.h"

namespace tacipc {

std::vector<std::string> manifest_columns();
/// Row of a sample that is in its shard, as its `offset`-th from 0.
std::vector<std::string> manifest_row(const PlannedRow& plan, const std::string& sensor_id, std::size_t offset,
                                      const SampleFrames& sample);
/// Row of one that is not: its status, and empty fields for all that only a made sample has.
std::vector<std::string> manifest_row(const PlannedRow& plan, const Failure& failure);

std::vector<std::string> failure_columns();
std::vector<std::string> failure_row(const PlannedRow& plan, const Failure& failure);

std::vector<std::string> timing_columns();
/// Seconds and megabytes of both stages; empty where a stage has left none.
std::vector<std::string> timing_row(const std::string& id, const std::filesystem::path& sample_folder);

}  // namespace tacipc
