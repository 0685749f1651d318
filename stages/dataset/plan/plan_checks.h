// Checks of a plan before anything runs.
#pragma once

#include <string>
#include <vector>

#include "common/sensor/sensor.h"
#include "stages/dataset/plan/dataset_config.h"

namespace tacipc {

/// Faults that no single key has: more samples or ranges than there can be, presses deeper than a gel is thick, objects
/// placed beside it. `sensors` are those of the configuration, read; `file` names it in the messages.
std::vector<std::string> faults_of_plan(const DatasetConfig& config, const std::vector<Sensor>& sensors,
                                        const std::string& file);

}  // namespace tacipc
