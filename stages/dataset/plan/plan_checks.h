// Checks a plan before anything runs.
#pragma once

#include <string>
#include <vector>

#include "common/sensor/sensor.h"
#include "stages/dataset/plan/dataset_config.h"

namespace tacipc {

/// Errors that concern several keys: more samples or ranges than possible, presses deeper than a gel is thick, objects
/// placed next to the gel instead of on it.
/// \param sensors sensors of the configuration, already read
/// \param file name of the configuration in messages
std::vector<std::string> faults_of_plan(const DatasetConfig& config, const std::vector<Sensor>& sensors,
                                        const std::string& file);

}  // namespace tacipc
