// One frame of the depth-based simulator.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "common/image/image.h"
#include "common/sensor/sensor.h"
#include "stages/rival/baseline/baseline_config.h"
#include "stages/rival/baseline/raster.h"

namespace tacipc {

struct BaselineFrame {
  FloatImage indentation;            // m, > 0 into the gel, without texture
  FloatImage depth;                  // m along the camera's axis, with texture
  std::optional<ByteImage> tactile;  // where the configuration shades
};

/// \pre depth and front of equal size; a background of that size where the configuration shades
BaselineFrame simulate_depth(const Raster& depth_m, const Raster& front_depth_m, const BaselineConfig& config,
                             const std::optional<ByteImage>& background);

/// Depth (m) of a float EXR as render writes it: channel Z.
Raster read_depth(const std::filesystem::path& path);

}  // namespace tacipc
