// One frame of the depth-based simulator.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "common/image.h"
#include "common/sensor.h"
#include "stages/baseline/baseline_config.h"
#include "stages/baseline/raster.h"

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

/// (4, 4) or (frames, 4, 4): rigid transforms gel_from_object. \throw DataError for another shape, for numbers that are
/// not finite, and for matrices that are no rigid motions (within 1e-6).
std::vector<Matrix4> read_poses(const std::filesystem::path& path);

}  // namespace tacipc
