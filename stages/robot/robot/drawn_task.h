// Draws the variables of a task file: each has a range, and `$name` in the file stands for its value.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace tacipc {

/// A task file with the values of its variables.
struct DrawnTask {
  std::string text;                                            // YAML with the values in place of the variables
  std::vector<std::pair<std::string, double>> variables = {};  // names and values, in the order of the file
};

/// Reads a task file and draws each variable of its section `variables`, uniformly from its range. A value depends on
/// `seed` and name alone; `seed` 0 takes the middle of each range.
/// \throw ConfigError if a range is not a number or [low, high]
DrawnTask draw_task(const std::filesystem::path& file, std::uint64_t seed);

}  // namespace tacipc
