// Refinement study: one scene computed repeatedly with one parameter refined, and the convergence of its results as
// files, tables and plots.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/value.h"
#include "verification/case_spec.h"

namespace tacipc::verify {

/// A parameter of the scene that changes by a constant factor from level to level.
struct RefinementStudy {
  std::string parameter;  // one of mesh, time_step, d_hat, speed_threshold
  double coarsest = 1.0;  // first level, in units of the scene's own value
  double factor = 2.0;    // ratio between successive levels
  int levels = 3;

  /// Factor that multiplies the scene's value on a level.
  double scale(int level) const;
};

/// Content of configs/studies/refinement/*.yaml.
struct RefinementSpec {
  CaseSpec scene;  // scene; it has no expectations
  double front_half_m = 0.0,
         front_pitch_m = 0.0;  // square grid of compared points on the front: half side and pitch, m
  std::vector<RefinementStudy> studies;

  static RefinementSpec read(ConfigReader& in);
  /// Study of a parameter.
  /// \throw UsageError, which lists the existing studies, if there is none
  const RefinementStudy& study(const std::string& parameter) const;
};

/// Scene with one parameter multiplied by `scale`.
/// - mesh: all cells of a box; the growth between neighbours is raised to the power `scale`, which keeps the grading.
/// - time_step: the step length and, inversely, the number of steps; the object's speed stays.
/// - d_hat: the barrier's reach; a relative stiffness scales with it.
/// - speed_threshold: ε_v.
/// \throw UsageError for a gel that is not a box, step counts that do not divide, or a scene without friction
CaseSpec refined(const CaseSpec& scene, const std::string& parameter, double scale);

/// Refined parameter in its own unit: size of the finest cells (mm), steps per mm of the last phase, µm, or µm/s.
struct ParameterValue {
  double value = 0.0;
  std::string name, unit;
};
ParameterValue parameter_value(const CaseSpec& scene, const std::string& parameter);

/// Compared quantities of one level, in the last frame.
struct RefinementLevel {
  int gel_vertices = 0;
  double press_force_n = 0.0, tangential_force_n = 0.0;
  Positions markers_m;  // displacement of the markers since the end of the press
  Positions front_m;    // displacement of the points of the front since rest

  std::string pack() const;
  /// \return nothing if the bytes are not those of a level
  static std::optional<RefinementLevel> unpack(std::string_view bytes);
};

/// Runs the scene on one level.
/// \throw SolverError if the press fails
RefinementLevel run_level(const RefinementSpec& spec, const CaseSpec& scene, const std::filesystem::path& shared);

/// One quantity over the levels: its difference from the finest level, and from the next finer one.
struct RefinementCurve {
  std::string quantity, unit;
  std::vector<double> values = {};                             // empty for fields, which are not a single number
  std::vector<double> against_finest = {}, against_next = {};  // differences for all levels but the last
  /// Order p in ‖f_k − f_{k+1}‖ ~ s_k^p, from each three successive levels. Differences of 0 give no order.
  std::vector<double> orders = {};
};

/// Press force, tangential force, markers (rms), front (rms and largest).
/// \pre all levels have the same points
std::vector<RefinementCurve> compare_levels(const std::vector<RefinementLevel>& levels, double factor);

/// One study, as stored in its result.yaml.
struct RefinementResult {
  std::string study;  // name of its folder and plot
  std::string title = {}, parameter = {}, unit = {};
  double factor = 0.0;
  std::vector<double> parameter_values = {};  // value on each level
  std::vector<int> gel_vertices = {};
  std::vector<RefinementCurve> curves = {};
  std::optional<std::string> failed = {};  // reason for a failure; only `study` is set in that case
};

/// Result with everything except the values of the levels.
RefinementResult describe(const RefinementSpec& spec, const RefinementStudy& study,
                          const std::vector<CaseSpec>& scenes);

Value to_value(const RefinementResult& result);
/// Reads the result in a study's folder; if there is no record, the reason of the failure.
/// \throw DataError, ConfigError for a file that is not such a result
RefinementResult read_refinement(const std::filesystem::path& folder);

/// Quantities whose difference from the next finer level is not smaller for the finest pair than for the coarsest.
std::vector<std::string> not_converging(const RefinementResult& result);

/// True if all studies succeeded and all their quantities converge.
bool holds(const std::vector<RefinementResult>& results);
/// One line of text: the change of the forces in the last refinement of each study, and failures.
std::string found(const std::vector<RefinementResult>& results);

/// Tables of all studies, each with its plot <plots>/refinement_<study>.svg.
std::string refinement_tables(const std::vector<RefinementResult>& results, const std::string& plots);
/// Log–log plot of the differences from the next finer level over the parameter, in percent of the finest value
/// (forces) or in µm (fields).
std::string refinement_svg(const RefinementResult& result);

}  // namespace tacipc::verify
