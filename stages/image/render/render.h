// Renders tactile images of the frames of one press, or of height maps.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/image/image.h"
#include "common/optics/develop.h"
#include "common/optics/trace.h"
#include "common/sensor/sensor.h"
#include "stages/image/render/deformation.h"
#include "stages/image/render/developer.h"
#include "stages/image/render/render_config.h"

namespace tacipc {

/// Photograph that the sensor names.
/// \throw DataError if its size is not the camera's
ByteImage read_reference(const std::filesystem::path& path, const Camera& camera);

/// Outputs of one frame in one unit.
struct RenderedFrame {
  std::size_t index = 0;
  std::string unit = {};
  const TraceResult* trace = nullptr;  // null if another unit's trace serves
  FloatImage linear = {};  // empty if it is not requested or the sensor's light is known only in grey levels
  std::vector<FloatImage> basis = {};  // image of each light group, if requested and the unit traced rays
  TactileImage tactile = {};
  std::optional<TactileImage> marker = std::nullopt;  // image with the printed markers, if requested and there are any
  Positions marker_px = {};                           // column, row and 1 for a visible marker, otherwise NaN and 0
};

/// Summary of a rendering, for the record.
struct RenderSummary {
  std::vector<std::size_t> frames = {};
  std::vector<UnitSummary> units = {};
  std::int64_t rays = 0;
  std::int64_t nudged_rays = 0;
  std::int64_t outside_rays = 0;
  double max_indentation_m = 0.0;  // indentation in the last frame
  double indirect_share = 0.0;     // indirect fraction of the last frame's light
};

/// Renders frame 0 (the reference, from the gel at rest), then the requested frames, with every unit, and passes each
/// to `deliver`.
/// \pre the first unit needs rays
/// \throw DataError if a unit without reference has no noise model, no light reaches the gel, or the camera sees none
RenderSummary render(const std::vector<RenderUnit>& units, const RenderConfig& config, const Deformation& front,
                     const std::function<void(const RenderedFrame&)>& deliver);

}  // namespace tacipc
