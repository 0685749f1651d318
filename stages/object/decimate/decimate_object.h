// From any scan to the mesh the simulation can afford, with the distance between the two.
#pragma once

#include "common/base/value.h"
#include "stages/object/decimate/decimate_config.h"

namespace tacipc {

struct DecimatedObject {
  TriangleMesh mesh;
  Value::Map summary;  // for the record; lengths in mm
};

/// Doctor, collapse, Hausdorff distance between what came in and what goes out. \throw DataError as they do.
DecimatedObject decimate_object(const TriangleMesh& scan, const DecimateConfig& config);

}  // namespace tacipc
