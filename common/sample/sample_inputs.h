// Inputs of every simulator of a sample: the motion, the object, and which side of it presses.
#pragma once

#include <string>

#include "common/mesh/triangle_mesh.h"
#include "common/sample/sample_spec.h"
#include "common/stage/stage.h"

namespace tacipc {

struct SampleInputs {
  SampleSpec sample;
  std::string face;     // that presses where the sample does not say
  TriangleMesh object;  // m
};

/// Reads the flags --sample, --object-config (where given: its `up` says which side looks away) and --object; the files
/// of paths become inputs of the stage.
SampleInputs read_sample(Stage& stage);

}  // namespace tacipc
