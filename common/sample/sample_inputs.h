// Reads the inputs that every simulator of a sample takes: motion, object, and the side that presses.
#pragma once

#include <string>

#include "common/mesh/triangle_mesh.h"
#include "common/sample/sample_spec.h"
#include "common/stage/stage.h"

namespace tacipc {

/// Inputs of a sample.
struct SampleInputs {
  SampleSpec sample;
  std::string face;     // side that presses if the sample names none
  TriangleMesh object;  // m
};

/// Reads the flags --sample, --object-config (if given: its `up` names the side that faces away) and --object. Files of
/// paths become inputs of the stage.
SampleInputs read_sample(Stage& stage);

}  // namespace tacipc
