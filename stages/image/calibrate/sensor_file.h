// Changes values in a sensor file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/base/value.h"
#include "common/sensor/sensor.h"

namespace tacipc {

/// Change or removal of one key of a sensor file.
struct SensorChange {
  std::string path;                           // keys joined by points, list items by number: leds.list[2].normal
  std::optional<Value> value = std::nullopt;  // absent: the key and `<key>_src` are removed if they exist
  std::string source = "derived";             // content of `<key>_src`: known, derived or guess
};

/// Text of the sensor file at `sensor` after these changes, with `comment` on its first line. All other keys, including
/// sources, keep position and text; comments of the file are lost. A new key goes to the end of its map, as do missing
/// maps on its path. Relative paths in the file stay as they are: a caller that writes the text elsewhere must change
/// them.
/// \throw ConfigError if the file is not a valid sensor
/// \throw DataError, listing the errors, if the changed text is not valid, or if a path names a missing list item
std::string changed_sensor(const std::filesystem::path& sensor, const std::vector<SensorChange>& changes,
                           const std::string& comment);

/// Sensor of the changed text. `content` is the file's ConfigReader::content.
/// \throw DataError, listing the errors, if the changed text is not valid, or if a path names a missing list item
Sensor changed_sensor(const Value& content, const std::vector<SensorChange>& changes);

}  // namespace tacipc
