// Shards as LeRobot datasets, format v3.0: Parquet tables with images inside, and JSON beside them.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "common/base/value.h"

namespace tacipc {

/// Where to write a file of this name.
using OutputPath = std::function<std::filesystem::path(const std::string& name)>;

/// A dataset `<sensor>/{meta,data}` for each sensor of the shards: samples are episodes, phases of their motion the
/// task, shards the data files, in the order train, val, test, so that splits are ranges of episodes. Features and
/// units are kFeatures of lerobot.cpp, as far as the shards have their fields. Returns what the record says of each.
/// \throw DataError for shards whose samples of one sensor differ in fields or shapes
Value::Map write_lerobot(std::vector<std::filesystem::path> shards, const OutputPath& output);

}  // namespace tacipc
