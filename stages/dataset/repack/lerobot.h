// Writes shards as LeRobot datasets, format v3.0: Parquet tables with images inside, and JSON files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/base/value.h"
#include "stages/dataset/repack/episodes.h"

namespace tacipc {

/// Writes a dataset `<kind>/{meta,data}` for each kind of episode (Episode::kind). The phases of the motion are the
/// task. Shards are the data files, in the order train, val, test, so that splits are ranges of episodes. Features and
/// units are those of lerobot_features, if the shards have their fields.
/// \return lines of the record for each dataset
/// \throw DataError if the episodes of one kind differ in fields or shapes
Value::Map write_lerobot(std::vector<std::filesystem::path> shards, const OutputPath& output);

}  // namespace tacipc
