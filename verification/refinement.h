// One scene computed repeatedly with one number refined: how fast the results converge, as files, tables and plots.
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

/// A number of the scene that is refined by a constant factor from level to level.
struct RefinementStudy {
  std::string parameter;  // mesh, time_step, d_hat, speed_threshold
  double coarsest = 1.0;  // first level, in units of the scene's own value
  double factor = 2.0;    // between levels
  int levels = 3;

  /// What the scene's value is multiplied by on a level.
  double scale(int level) const;
};

/// configs/studies/refinement/*.yaml
struct RefinementSpec {
  CaseSpec scene;                                  // without expectations
  double front_half_m = 0.0, front_pitch_m = 0.0;  // points of the front that are compared: a square grid
  std::vector<RefinementStudy> studies;

  static RefinementSpec read(ConfigReader& in);
  /// \throw UsageError naming those there are
  const RefinementStudy& study(const std::string& parameter) const;
};

/// The scene with one parameter multiplied by `scale`.
/// - mesh: all cells of a box, the growth between neighbours taken to the power `scale`: the same grading, finer.
/// - time_step: its length and, inversely, the number of steps: the object moves as fast as before.
/// - d_hat: the barrier's reach; a relative stiffness goes with it.
/// - speed_threshold: ε_v.
/// \throw UsageError for a gel that is not a box, steps that do not divide, or a scene without friction
CaseSpec refined(const CaseSpec& scene, const std::string& parameter, double scale);

/// The refined parameter in its own unit: mm of the finest cells, steps per mm of the last phase, µm, µm/s.
struct ParameterValue {
  double value = 0.0;
  std::string name, unit;
};
ParameterValue parameter_value(const CaseSpec& scene, const std::string& parameter);

/// Compared quantities, of the last frame.
struct RefinementLevel {
  int gel_vertices = 0;
  double press_force_n = 0.0, tangential_force_n = 0.0;
  Positions markers_m;  // displacement of the markers since the end of the press
  Positions front_m;    // displacement of the points of the front since rest

  std::string pack() const;
  /// Nothing if the bytes are not those of a level.
  static std::optional<RefinementLevel> unpack(std::string_view bytes);
};

/// Runs the scene. \throw SolverError if the press fails
RefinementLevel run_level(const RefinementSpec& spec, const CaseSpec& scene, const std::filesystem::path& shared);

/// One quantity over the levels: its difference from the finest level, and from the next finer one.
struct RefinementCurve {
  std::string quantity, unit;
  std::vector<double> values = {};                             // empty for fields, which are not a single number
  std::vector<double> against_finest = {}, against_next = {};  // of all levels but the last
  /// p in ‖f_k − f_{k+1}‖ ~ s_k^p, from each three successive levels; those of differences that are 0 are left out.
  std::vector<double> orders = {};
};

/// Press force, tangential force, markers (rms), front (rms and largest). \pre all levels have the same points
std::vector<RefinementCurve> compare_levels(const std::vector<RefinementLevel>& levels, double factor);

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
