// The fit as files that other stages take: the sensor file, and an ensemble of changes of it.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "common/sample/ensemble.h"
#include "stages/study/identify/identify_report.h"

namespace tacipc {

/// Changes of a sensor file (key → YAML) that a set of unknowns means.
std::map<std::string, std::string> sensor_changes(const MechanicsModel& model, const Eigen::VectorXd& u);
/// The sensor file with the fitted mechanics. Behind every value of gel, material and mount stands where it comes from:
/// [fitted ± deviation], [measured] or [guess].
std::string fitted_sensor(const std::string& text, const std::string& name, const IdentifyResult& result);
/// Members drawn from the posterior, as changes of the sensor file at `sensor`.
Ensemble ensemble_of(const IdentifyResult& result, const std::filesystem::path& sensor, int members);

}  // namespace tacipc
