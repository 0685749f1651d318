// A sensor file with other values in it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/base/value.h"
#include "common/sensor/sensor.h"

namespace tacipc {

/// One key of a sensor file that gets another value, or goes.
struct SensorChange {
  std::string path;                           // keys joined by points, items of lists by number: leds.list[2].normal
  std::optional<Value> value = std::nullopt;  // nothing: key and `<key>_src` go, if they are there
  std::string source = "derived";             // what `<key>_src` says beside it: known, derived or guess
};

/// Text of the sensor file at `sensor` with these changes made in turn and `comment` on its first line. All other keys,
/// sources among them, keep place and text; comments of the file are lost. A new key goes to the end of its map, as do
/// missing maps on its path. Relative paths in the file stay as they are: whoever writes the text
/// elsewhere has to change them.
/// \throw ConfigError if the file is not a valid sensor; DataError, with its faults, if the changed text is none, or if
/// a path names an item that no list has.
std::string changed_sensor(const std::filesystem::path& sensor, const std::vector<SensorChange>& changes,
                           const std::string& comment);

/// The sensor that the changed text describes; `content` is what ConfigReader::content says of the file.
/// \throw DataError as above
Sensor changed_sensor(const Value& content, const std::vector<SensorChange>& changes);

}  // namespace tacipc
