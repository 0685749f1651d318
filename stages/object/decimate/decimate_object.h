// From any scan to the mesh the simulation can afford, with the distance between the two.
#pragma once

#include <optional>

#include "common/base/value.h"
#include "common/image/image.h"
#include "stages/object/decimate/decimate_config.h"

namespace tacipc {

struct DecimatedObject {
  TriangleMesh mesh;
  Value::Map summary;                             // for the record; lengths in mm
  std::optional<ByteImage> sides = std::nullopt;  // picture of what each shows, where a sensor's window is known
};

/// Doctor, collapse, Hausdorff distance between what came in and what goes out; then, for a sensor, which side to
/// press. \throw DataError as they do.
DecimatedObject decimate_object(const TriangleMesh& scan, const DecimateConfig& config);

}  // namespace tacipc
