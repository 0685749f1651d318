// One frame of a simulator that knows the object's depth alone.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "common/image/image.h"
#include "common/sensor/sensor.h"
#include "stages/rival/baseline/baseline_config.h"
#include "stages/rival/baseline/change.h"
#include "stages/rival/baseline/raster.h"

namespace tacipc {

struct BaselineFrame {
  FloatImage indentation;            // m, > 0 into the gel, without texture
  FloatImage depth;                  // m along the camera's axis, with texture
  std::optional<ByteImage> tactile;  // where the configuration shades
  double membrane_s = 0.0;           // processor time of membrane and light
  double light_s = 0.0;
};

/// \pre object and front of equal size; a background of that size where the configuration shades, and what changes its
/// codes where it does that
BaselineFrame simulate_depth(SeenObject seen, const Raster& front_depth_m, const BaselineConfig& config,
                             const std::optional<ByteImage>& background, const ChangeOfCodes* change);

/// Depth (m) of a float EXR as render writes it: channel Z.
Raster read_depth(const std::filesystem::path& path);

/// Processor time of this process, s.
double processor_s();

}  // namespace tacipc
