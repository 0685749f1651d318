// Reads the presses at every node from the files of `press`, and the measured tables.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "common/benchmark/identify_spec.h"
#include "stages/study/identify/model.h"

namespace tacipc {

/// Maps a node (or a check) and a run_name to the folder of that press.
using RunFolder = std::function<std::filesystem::path(const std::string& node, const std::string& run)>;

/// Force over the depth of the frames, mm, in N per Pa of the modulus with which presses to `depth_mm` were run.
/// \throw DataError if the gel's wrench or the object's pose is missing, or the press is not one into the gel
CurveTable read_press_table(const std::vector<std::filesystem::path>& folders, double modulus_pa, double depth_mm);

/// Reads the simulated and measured data of every measurement.
/// \throw DataError if a table has no fitted row, a row is deeper than the simulation, or runs do not fit together
std::vector<MeasurementData> read_measurements(const IdentifySpec& spec, const RunFolder& folder,
                                               const std::map<std::string, std::filesystem::path>& measured,
                                               double modulus_pa);

}  // namespace tacipc
