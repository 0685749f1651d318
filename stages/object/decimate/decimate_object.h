// Reduces any scan to a mesh that is small enough to simulate, and measures the distance between both.
#pragma once

#include <optional>

#include "common/base/value.h"
#include "common/image/image.h"
#include "stages/object/decimate/decimate_config.h"

namespace tacipc {

/// Result of decimate.
struct DecimatedObject {
  TriangleMesh mesh;
  Value::Map summary;                             // lines for the record; lengths in mm
  std::optional<ByteImage> sides = std::nullopt;  // picture of the six sides, if a sensor's field of view is known
};

/// Runs mesh doctor, edge collapse, and the Hausdorff distance between input and output; then, for a sensor, selects
/// the side to press.
/// \throw DataError as these steps do
DecimatedObject decimate_object(const TriangleMesh& scan, const DecimateConfig& config);

}  // namespace tacipc
