// Writes the fit as files that other stages read: the sensor file, and an ensemble of changes to it.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "common/sample/ensemble.h"
#include "stages/study/identify/identify_report.h"

namespace tacipc {

/// Changes of a sensor file (key → YAML) that correspond to the unknowns u.
std::map<std::string, std::string> sensor_changes(const MechanicsModel& model, const Eigen::VectorXd& u);
/// Sensor file with the fitted mechanics. Every value of gel, material and mount is followed by its source: [fitted ±
/// deviation], [measured] or [guess].
/// \param text sensor file before the fit
std::string fitted_sensor(const std::string& text, const std::string& name, const IdentifyResult& result);
/// Ensemble of members drawn from the posterior, as changes of the sensor file at `sensor`.
Ensemble ensemble_of(const IdentifyResult& result, const std::filesystem::path& sensor, int members);

}  // namespace tacipc
