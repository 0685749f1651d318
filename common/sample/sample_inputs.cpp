#include "common/sample/sample_inputs.h"

#include "common/sample/object.h"
#include "common/sample/placement.h"

namespace tacipc {

SampleInputs read_sample(Stage& stage) {
  SampleInputs inputs{.sample = stage.read_config<SampleSpec>("--sample"), .face = "-z", .object = {}};
  if (stage.optional_input("--object-config")) {
    if (const auto up = stage.read_config<ObjectSpec>("--object-config").up) inputs.face = opposite_face(*up);
  }
  for (const Phase& phase : inputs.sample.motion) {
    if (phase.kind == PhaseKind::path) stage.add_input("path", phase.file);
  }
  inputs.object = read_triangle_mesh(stage.input("--object"), 1.0);
  return inputs;
}

}  // namespace tacipc
