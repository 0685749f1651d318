// Kinds of patterns, each with its keys.
#pragma once

#include <filesystem>
#include <variant>

#include "common/config/config.h"
#include "stages/object/emboss/outline.h"
#include "stages/object/emboss/texture.h"

namespace tacipc {

/// Pattern with an outline; the relief adds the walls.
struct Outline {
  Distance distance;
};

/// Pattern with a height everywhere.
struct Texture {
  Height height;
};

/// Picture that is still to be read from its file.
struct PictureSource {
  std::filesystem::path path;
  double width_m = 0.0;
  bool dark_is_high = false;
};

using Pattern = std::variant<Outline, Texture, PictureSource>;

/// A length in metres from a key in millimetres.
double length(ConfigReader& in, const std::string& key, const Range& range = Range::positive());

/// Reads `pattern:`. `free_radius_m` is the radius of the circle that patterns may fill; it is an error if a pattern
/// that must stay whole (text, polygon, star, gear) exceeds it. A picture's path is relative to the YAML's folder.
Pattern read_pattern(ConfigReader& in, double free_radius_m);

}  // namespace tacipc
