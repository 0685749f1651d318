// The fit as tables, plots and files that other stages take.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "common/base/value.h"
#include "common/sample/ensemble.h"
#include "stages/study/identify/fit.h"
#include "stages/study/identify/predictions.h"

namespace tacipc {

/// An unknown after the fit.
struct Estimate {
  std::string name, measurement;
  double value = 0.0;            // of the mean of the draws
  double sigma = 0.0;            // of the draws
  double low = 0.0, high = 0.0;  // 95 % of the draws lie between
  Prior prior;
  bool told = false;  // by the measurements, else by the prior
  bool at_bound = false;
  bool against_prior = false;  // three or more of its deviations from the prior's mean
};
std::vector<Estimate> estimates_of(const MechanicsModel& model, const Fit& fit, const Posterior& posterior);

/// Of the vectors of a photograph, fitted or predicted: how many, the mean lengths of what was measured and of the
/// error, px, and the share of coordinates that lie in their 95 % interval.
struct MarkerErrors {
  std::string photograph;
  bool fitted = false;
  int vectors = 0;
  double measured_px = 0.0, error_px = 0.0, inside = 0.0;
};
/// By measurement, of press and shear: fitted, then predicted, each half of the markers by a fit to the other half.
std::map<std::size_t, std::vector<MarkerErrors>> all_marker_errors(MechanicsModel& model, const Posterior& posterior);

struct IdentifyResult {
  const MechanicsModel& model;
  Fit fit;
  Posterior posterior;
  Eigen::VectorXd u;  // mean of the draws: what is reported, and written to the sensor file
  std::vector<Estimate> estimates;
  std::vector<ForcePrediction> forces;
  std::map<std::string, double> modulus_error;  // by check
  std::map<std::size_t, std::vector<MarkerErrors>> markers;
};

/// Root mean square of (model − measured) / deviation over the fitted rows.
double misfit(const MechanicsModel& model, std::size_t measurement, const Eigen::VectorXd& u);

/// Markdown: the unknowns of the sensor, then forces measured and predicted, then markers.
std::string result_table(const IdentifyResult& result);
/// Lines of the record's summary.
Value::Map result_summary(const IdentifyResult& result);
/// SVG files by name: curve_<measurement>.svg with residual_<measurement>.svg, or press and shear of markers.
std::map<std::string, std::string> result_plots(const IdentifyResult& result);
/// |residuals|² above the least over an unknown, with the prior's own parabola.
std::string profile_plot(const Unknown& unknown, const Fit& fit, Eigen::Index index,
                         const std::vector<ProfilePoint>& points);

/// Changes of a sensor file (key → YAML) that a set of unknowns means.
std::map<std::string, std::string> sensor_changes(const MechanicsModel& model, const Eigen::VectorXd& u);
/// The sensor file with the fitted mechanics. Behind every value of gel, material and mount stands where it comes from:
/// [fitted ± deviation], [measured] or [guess].
std::string fitted_sensor(const std::string& text, const std::string& name, const IdentifyResult& result);
/// Members drawn from the posterior, as changes of the sensor file at `sensor`.
Ensemble ensemble_of(const IdentifyResult& result, const std::filesystem::path& sensor, int members);

}  // namespace tacipc
