// What a press leaves behind: arrays per frame and the numbers of its record.
#pragma once

#include "common/stage.h"
#include "stages/press/simulate.h"

namespace tacipc {

/// positions.npy, object_pose.npy, contact_force.npy, wrench.npy (shapes and units in docs/files.md) and the summary.
void write_outputs(Stage& stage, const Simulation& simulation);

}  // namespace tacipc
