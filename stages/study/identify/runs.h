// Presses at every node, as the files of the press stage tell them, and the tables they are compared with.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "common/benchmark/identify_spec.h"
#include "stages/study/identify/model.h"

namespace tacipc {

/// Folder of the press of a measurement at a node (or of a check), by run_name.
using RunFolder = std::function<std::filesystem::path(const std::string& node, const std::string& run)>;

/// Force, N per Pa of the modulus that presses to `depth_mm` were run with, over the depth of their frames, mm. \throw
/// DataError if the gel's wrench or the object's pose are missing or the press is not one into the gel
CurveTable read_press_table(const std::vector<std::filesystem::path>& folders, double modulus_pa, double depth_mm);

/// Reads what was simulated and measured for every measurement. \throw DataError where a table has no fitted row, a row
/// is deeper than what is simulated, or runs do not fit together
std::vector<MeasurementData> read_measurements(const IdentifySpec& spec, const RunFolder& folder,
                                               const std::map<std::string, std::filesystem::path>& measured,
                                               double modulus_pa);

}  // namespace tacipc
