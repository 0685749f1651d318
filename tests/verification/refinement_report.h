// Studies of refinement as files, tables and plots.
#pragma once

#include "common/value.h"
#include "tests/verification/refinement.h"

namespace tacipc::verify {

/// One study as its result.yaml holds it.
struct RefinementResult {
  std::string study;  // name of its folder and plot
  std::string title = {}, parameter = {}, unit = {};
  double factor = 0.0;
  std::vector<double> parameter_values = {};  // of each level
  std::vector<int> gel_vertices = {};
  std::vector<RefinementCurve> curves = {};
};

/// Everything but what the levels give.
RefinementResult describe(const RefinementSpec& spec, const RefinementStudy& study,
                          const std::vector<CaseSpec>& scenes);

Value to_value(const RefinementResult& result);
/// \throw DataError, ConfigError for a file that is no such result
RefinementResult read_refinement(const std::filesystem::path& result_yaml);

/// Quantities whose difference from the next finer level is not smaller at the finest pair than at the coarsest.
std::vector<std::string> not_settling(const RefinementResult& result);

/// Tables of all studies, each with its picture <plots>/refinement_<study>.svg.
std::string refinement_tables(const std::vector<RefinementResult>& results, const std::string& plots);
/// Differences from the next finer level over the parameter, both logarithmic, in percent of the finest value (forces)
/// or in µm (fields).
std::string refinement_svg(const RefinementResult& result);

}  // namespace tacipc::verify
