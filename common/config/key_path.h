// Values inside a configuration or record by a path such as `gel.layers[0].thickness_m`.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "common/base/value.h"

namespace tacipc {

/// From a map to what a key holds, or from a list to an item.
using KeyStep = std::variant<std::string, std::size_t>;

/// How far a path leads.
struct KeyPath {
  std::vector<KeyStep> steps;  // that are there
  std::string rest;            // of the path, which is not there; empty: all of it is
  const Value* at;             // where the steps lead
};

/// Follows a path: keys joined by points, items of lists by their index in brackets. Keys that hold points or brackets
/// themselves, such as names of files, are found as they are: the longest key that fits is taken.
KeyPath follow(const Value& root, std::string_view path);

/// The path as text.
std::string to_text(const std::vector<KeyStep>& steps);

/// The first key of a path.
std::string_view first_key(std::string_view path);

/// ` (did you mean …?)` with the key of a map that is near to a word; empty where there is none.
std::string suggestion(const Value& map, std::string_view word);

}  // namespace tacipc
