#include "stages/image/calibrate/sensor_file.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <string_view>

#include "common/base/error.h"
#include "common/config/config.h"

namespace tacipc {
namespace {

using Entries = Value::Map;

Entries::iterator find_key(Entries& map, std::string_view key) {
  return std::ranges::find_if(map, [&](const auto& entry) { return entry.first == key; });
}

void put(Entries& map, const std::string& key, const SensorChange& change) {
  const std::string source_key = key + "_src";
  if (const auto source = find_key(map, source_key); source != map.end()) map.erase(source);
  auto entry = find_key(map, key);
  if (!change.value) {
    if (entry != map.end()) map.erase(entry);
    return;
  }
  if (entry == map.end()) entry = map.emplace(map.end(), key, Value());
  entry->second = *change.value;
  map.emplace(entry + 1, source_key, Value(change.source));
}

/// Item `[number]…` of a list; `rest` then begins after the bracket.
Value& item_of(Value& list, std::string_view& rest, const std::string& path) {
  const std::size_t end = rest.find(']');
  std::size_t number = 0;
  const auto parsed = std::from_chars(rest.data() + 1, rest.data() + end, number);
  assert(end != std::string_view::npos && parsed.ec == std::errc());
  static_cast<void>(parsed);
  auto* items = std::get_if<Value::List>(&list.data());
  if (!items || number >= items->size()) throw DataError("{}: the sensor file has no such item", path);
  rest.remove_prefix(end + 1);
  return (*items)[number];
}

void apply(Value& document, const SensorChange& change) {
  Value* at = &document;
  std::string_view rest = change.path;
  for (;;) {
    auto* map = std::get_if<Entries>(&at->data());
    if (!map) throw DataError("{}: the sensor file has no map there", change.path);
    const std::size_t length = std::min(rest.find_first_of(".["), rest.size());
    const std::string key(rest.substr(0, length));
    rest.remove_prefix(length);
    if (rest.empty()) return put(*map, key, change);
    auto entry = find_key(*map, key);
    if (entry == map->end()) {
      if (!change.value) return;
      entry = map->emplace(map->end(), key, Value());
    }
    at = &entry->second;
    while (!rest.empty() && rest.front() == '[') at = &item_of(*at, rest, change.path);
    assert(!rest.empty() && rest.front() == '.');
    rest.remove_prefix(1);
  }
}

Sensor read_sensor(ConfigReader& in) {
  Sensor sensor = Sensor::read(in);
  in.finish();
  return sensor;
}

std::string changed_text(Value content, const std::vector<SensorChange>& changes) {
  for (const SensorChange& change : changes) apply(content, change);
  return to_yaml(content);
}

Sensor sensor_of(const std::string& text) {
  try {
    ConfigReader in = ConfigReader::from_text(text, "the fitted sensor");
    return read_sensor(in);
  } catch (const ConfigError& error) {
    throw DataError("what was fitted makes no valid sensor:\n{}", error.what());
  }
}

}  // namespace

std::string changed_sensor(const std::filesystem::path& sensor, const std::vector<SensorChange>& changes,
                           const std::string& comment) {
  ConfigReader in = ConfigReader::from_file(sensor);
  const Value content = in.content();
  read_sensor(in);
  const std::string text = "# " + comment + "\n" + changed_text(content, changes);
  sensor_of(text);
  return text;
}

Sensor changed_sensor(const Value& content, const std::vector<SensorChange>& changes) {
  return sensor_of(changed_text(content, changes));
}

}  // namespace tacipc
