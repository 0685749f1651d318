// What a press leaves behind: arrays per frame and the numbers of its record.
#pragma once

#include "common/stage.h"
#include "stages/press/simulate.h"

namespace tacipc {

/// Every array of docs/files.md that press writes, and the summary of its record.
void write_outputs(Stage& stage, const Sensor& sensor, const TetMesh& gel, const PressConfig& config,
                   const SampleSpec& sample, const Simulation& simulation);

}  // namespace tacipc
