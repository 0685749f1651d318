// The fit as tables, plots and lines of the record.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "common/base/value.h"
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
/// A deviation as tables and files have it: two digits.
std::string deviation_text(double sigma);

std::vector<Estimate> estimates_of(const MechanicsModel& model, const Fit& fit, const Posterior& posterior);

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

}  // namespace tacipc
