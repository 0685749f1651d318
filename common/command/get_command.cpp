#include <fmt/core.h>

#include <filesystem>
#include <optional>

#include "common/base/error.h"
#include "common/command/file_commands.h"
#include "common/config/config.h"
#include "common/config/key_path.h"

namespace tacipc {
namespace {

/// Returns a single value as a line, a list as one line per item, a map as lines of YAML.
std::string lines_of(const Value& value, const std::string& place) {
  if (const auto* text = std::get_if<std::string>(&value.data())) return *text + "\n";
  if (std::holds_alternative<Value::Map>(value.data())) return to_yaml(value);
  std::string lines;
  for (const Value& item : std::get<Value::List>(value.data())) {
    const auto* text = std::get_if<std::string>(&item.data());
    if (!text) throw DataError("{}: is not a list of single values; ask for a part, such as [0]", place);
    lines += *text + "\n";
  }
  return lines;
}

/// Returns a line for each map of a list: its values at these keys, separated by tabs.
std::string rows_of(const Value& value, const GetRequest& request, const std::string& place) {
  const auto* list = std::get_if<Value::List>(&value.data());
  if (!list) throw DataError("{}: is not a list", place);
  std::string lines;
  for (std::size_t i = 0; i < list->size(); ++i) {
    for (const std::string& field : request.fields) {
      const KeyPath found = follow((*list)[i], field);
      const auto* text = found.rest.empty() ? std::get_if<std::string>(&found.at->data()) : nullptr;
      const bool absent = !found.rest.empty();
      if (!text && !(absent && request.fallback)) throw DataError("{}[{}]: has no single value {}", place, i, field);
      lines += (text ? *text : *request.fallback) + '\t';
    }
    lines.back() = '\n';
  }
  return lines;
}

std::string keys_of(const Value& value, const std::string& place) {
  const auto* map = std::get_if<Value::Map>(&value.data());
  if (!map) throw DataError("{}: has no keys", place);
  std::string lines;
  for (const auto& entry : *map) lines += entry.first + "\n";
  return lines;
}

}  // namespace

std::string get_values(const GetRequest& request) {
  std::optional<Value> content;
  std::error_code error;
  if (!request.fallback || std::filesystem::exists(request.file, error)) {
    ConfigReader in = ConfigReader::from_file(request.file);
    for (const std::string& key : in.keys()) in.ignore(key);
    in.finish();
    content = in.content();
  }
  std::string lines;
  for (const std::string& path : request.keys) {
    const std::string place = fmt::format("{}: {}", request.file, path);
    const KeyPath found = content ? follow(*content, path) : KeyPath{.steps = {}, .rest = path, .at = nullptr};
    if (found.rest.empty()) {
      lines += request.only_keys         ? keys_of(*found.at, place)
               : !request.fields.empty() ? rows_of(*found.at, request, place)
                                         : lines_of(*found.at, place);
    } else if (request.fallback) {
      lines += *request.fallback + "\n";
    } else {
      throw DataError("{}: there is no such key{}", place, suggestion(*found.at, first_key(found.rest)));
    }
  }
  return lines;
}

}  // namespace tacipc
