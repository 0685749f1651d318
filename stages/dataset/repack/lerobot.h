// Shards as LeRobot datasets, format v3.0: Parquet tables with images inside, and JSON beside them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/base/value.h"
#include "stages/dataset/repack/episodes.h"

namespace tacipc {

/// A dataset `<kind>/{meta,data}` for each kind of episode (Episode::kind): phases of the motion are the task, shards
/// the data files, in the order train, val, test, so that splits are ranges of episodes. Features and units are those
/// of lerobot_features, as far as the shards have their fields. Returns what the record says of each. \throw DataError
/// for shards whose episodes of one kind differ in fields or shapes
Value::Map write_lerobot(std::vector<std::filesystem::path> shards, const OutputPath& output);

}  // namespace tacipc
