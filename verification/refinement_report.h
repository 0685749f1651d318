// Studies of refinement as files, tables and plots.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/base/value.h"
#include "verification/refinement.h"

namespace tacipc::verify {

/// One study as its result.yaml holds it.
struct RefinementResult {
  std::string study;  // name of its folder and plot
  std::string title = {}, parameter = {}, unit = {};
  double factor = 0.0;
  std::vector<double> parameter_values = {};  // of each level
  std::vector<int> gel_vertices = {};
  std::vector<RefinementCurve> curves = {};
  std::optional<std::string> failed = {};  // why there is nothing but the study's name
};

/// All but the results of the levels.
RefinementResult describe(const RefinementSpec& spec, const RefinementStudy& study,
                          const std::vector<CaseSpec>& scenes);

Value to_value(const RefinementResult& result);
/// The result in a study's folder; without a record, why it failed.
/// \throw DataError, ConfigError for a file that is not such a result
RefinementResult read_refinement(const std::filesystem::path& folder);

/// Quantities whose difference from the next finer level is not smaller at the finest pair than at the coarsest.
std::vector<std::string> not_converging(const RefinementResult& result);

/// All studies succeeded, and every quantity of them converges.
bool holds(const std::vector<RefinementResult>& results);
/// How much the forces still change in the last refinement of each study, and what failed or does not converge.
std::string found(const std::vector<RefinementResult>& results);

/// Tables of all studies, each with its picture <plots>/refinement_<study>.svg.
std::string refinement_tables(const std::vector<RefinementResult>& results, const std::string& plots);
/// Differences from the next finer level over the parameter, both logarithmic, in percent of the finest value (forces)
/// or in µm (fields).
std::string refinement_svg(const RefinementResult& result);

}  // namespace tacipc::verify
