// schema.json: every field of a dataset for readers that have only the file.
#pragma once

#include "common/base/value.h"
#include "stages/dataset/pack/pack_config.h"

namespace tacipc {

/// Name and version of the format, conventions, what the letters of shapes mean, and each field with its attributes and
/// whether this dataset packs it.
Value schema(const PackConfig& config, bool with_ensemble);

}  // namespace tacipc
