#include "common/config/key_path.h"

#include <fmt/core.h>

#include <charconv>

#include "common/config/config.h"

namespace tacipc {
namespace {

/// Returns the rest of a path after `word`; null if the path does not begin with it.
const char* after(std::string_view path, std::string_view word) {
  if (!path.starts_with(word)) return nullptr;
  if (path.size() == word.size()) return path.data() + path.size();
  const char next = path[word.size()];
  if (next == '.') return path.data() + word.size() + 1;
  return next == '[' ? path.data() + word.size() : nullptr;
}

/// Returns the index of `[index]` at the start of a path and removes it; the list's size if there is none.
std::size_t take_index(std::string_view& path, std::size_t size) {
  std::size_t index = 0;
  if (path.empty() || path.front() != '[') return size;
  const char* end = path.data() + path.size();
  const auto [last, error] = std::from_chars(path.data() + 1, end, index);
  if (error != std::errc() || last == end || *last != ']' || index >= size) return size;
  path.remove_prefix(static_cast<std::size_t>(last + 1 - path.data()));
  if (path.starts_with('.')) path.remove_prefix(1);
  return index;
}

}  // namespace

KeyPath follow(const Value& root, std::string_view path) {
  KeyPath result{.steps = {}, .rest = {}, .at = &root};
  while (!path.empty()) {
    if (const auto* map = std::get_if<Value::Map>(&result.at->data())) {
      const Value::Map::value_type* found = nullptr;
      for (const auto& entry : *map) {
        if (after(path, entry.first) && (!found || entry.first.size() > found->first.size())) found = &entry;
      }
      if (!found) break;
      const char* rest = after(path, found->first);
      path.remove_prefix(static_cast<std::size_t>(rest - path.data()));
      result.steps.emplace_back(found->first);
      result.at = &found->second;
    } else if (const auto* list = std::get_if<Value::List>(&result.at->data())) {
      const std::size_t index = take_index(path, list->size());
      if (index == list->size()) break;
      result.steps.emplace_back(index);
      result.at = &(*list)[index];
    } else {
      break;
    }
  }
  result.rest = path;
  return result;
}

std::string to_text(const std::vector<KeyStep>& steps) {
  std::string text;
  for (const KeyStep& step : steps) {
    if (const auto* index = std::get_if<std::size_t>(&step)) {
      text += fmt::format("[{}]", *index);
    } else {
      text += (text.empty() ? "" : ".") + std::get<std::string>(step);
    }
  }
  return text;
}

std::string_view first_key(std::string_view path) { return path.substr(0, path.find_first_of(".[")); }

std::string suggestion(const Value& value, std::string_view word) {
  const auto* map = std::get_if<Value::Map>(&value.data());
  if (!map) return "";
  std::vector<std::string> keys;
  for (const auto& entry : *map) keys.push_back(entry.first);
  const auto near = nearest_word(word, keys);
  return near ? fmt::format(" (did you mean {}?)", *near) : "";
}

}  // namespace tacipc
