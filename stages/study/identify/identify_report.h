// Reports the fit as tables, plots and lines of the record.
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
  double value = 0.0;            // value at the mean of the draws
  double sigma = 0.0;            // standard deviation of the draws
  double low = 0.0, high = 0.0;  // 95 % of the draws lie between
  Prior prior;
  bool told = false;  // true: determined by the measurements; false: by the prior
  bool at_bound = false;
  bool against_prior = false;  // three or more standard deviations of the prior from its mean
};
/// Text of a standard deviation for tables and files: two digits.
std::string deviation_text(double sigma);

std::vector<Estimate> estimates_of(const MechanicsModel& model, const Fit& fit, const Posterior& posterior);

/// Everything that the reports show.
struct IdentifyResult {
  const MechanicsModel& model;
  Fit fit;
  Posterior posterior;
  Eigen::VectorXd u;  // mean of the draws, which is reported and written to the sensor file
  std::vector<Estimate> estimates;
  std::vector<ForcePrediction> forces;
  std::map<std::string, double> modulus_error;  // relative error of the modulus by check
  std::map<std::size_t, std::vector<MarkerErrors>> markers;
};

/// Root mean square of (model − measured) / deviation over the fitted rows.
double misfit(const MechanicsModel& model, std::size_t measurement, const Eigen::VectorXd& u);

/// Markdown tables: the unknowns of the sensor, then forces measured and predicted, then markers.
std::string result_table(const IdentifyResult& result);
/// Lines of the record's summary.
Value::Map result_summary(const IdentifyResult& result);
/// SVG files by name: curve_<measurement>.svg with residual_<measurement>.svg, or press and shear of markers.
std::map<std::string, std::string> result_plots(const IdentifyResult& result);
/// Plot of |residuals|² above the minimum over an unknown, with the parabola of the prior.
std::string profile_plot(const Unknown& unknown, const Fit& fit, Eigen::Index index,
                         const std::vector<ProfilePoint>& points);

}  // namespace tacipc
