// A task with ranges: each of its variables is drawn by a seed, and stands in the file as $name.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace tacipc {

struct DrawnTask {
  std::string text;                                            // YAML without variables
  std::vector<std::pair<std::string, double>> variables = {};  // in the order of the file
};

/// Numbers evenly distributed in the ranges of the section `variables`, functions of seed and name alone; `seed` 0
/// takes the middle of each range. \throw ConfigError if a range is not a number or [low, high]
DrawnTask draw_task(const std::filesystem::path& file, std::uint64_t seed);

}  // namespace tacipc
