// Finds values inside a configuration or record by a path such as `gel.layers[0].thickness_m`.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "common/base/value.h"

namespace tacipc {

/// Step of a path: a key of a map, or an index of a list.
using KeyStep = std::variant<std::string, std::size_t>;

/// Result of following a path.
struct KeyPath {
  std::vector<KeyStep> steps;  // steps that exist
  std::string rest;            // rest of the path, which does not exist; empty if the whole path exists
  const Value* at;             // value at the end of the steps
};

/// Follows a path: keys joined by points, items of lists by their index in brackets. Keys that contain points or
/// brackets, such as file names, are also found: the longest matching key is taken.
KeyPath follow(const Value& root, std::string_view path);

/// Returns the path as text.
std::string to_text(const std::vector<KeyStep>& steps);

/// Returns the first key of a path.
std::string_view first_key(std::string_view path);

/// Returns ` (did you mean …?)` with the key of a map that is similar to a word; empty if there is none.
std::string suggestion(const Value& map, std::string_view word);

}  // namespace tacipc
