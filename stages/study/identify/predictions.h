// Presses and marker vectors by the fitted mechanics, beside measured ones: those that were fitted and those that were
// not.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "stages/study/identify/fit.h"

namespace tacipc {

/// Force of a press to a depth.
struct ForcePrediction {
  std::string measurement;
  double depth_mm = 0.0;
  bool fitted = false;
  double force_n = 0.0;              // of the mean of the draws
  double parameter_sigma = 0.0;      // N, of the draws
  double model_sigma = 0.0;          // N, what the checks change
  double low_n = 0.0, high_n = 0.0;  // 95 % of what a measurement would say lies between: both, and its own error
  std::optional<double> measured_n = std::nullopt;

  bool covered() const { return measured_n && *measured_n >= low_n && *measured_n <= high_n; }
};

/// Of each check, for each measurement of a press: the force at the middle node over its depths, and with the check.
struct CheckedPress {
  std::string check;
  std::size_t measurement = 0;
  CurveTable table;  // rows: as it is, checked
};

/// Relative change of a press's force at a depth of its table by the checks, that of the modulus it makes at the fitted
/// rows left out: root of the sum of squares over the checks.
double model_error(const std::vector<CheckedPress>& checks, const MechanicsModel& model, std::size_t measurement,
                   double depth_mm);
/// What each check changes in ln(force), mean over the fitted rows of each press, and over the presses: the modulus
/// changes by as much the other way.
std::map<std::string, double> modulus_error(const std::vector<CheckedPress>& checks, const MechanicsModel& model);

/// Every row of every press, and the depths of Measurement::predict_mm that have none, ascending.
std::vector<ForcePrediction> predict_forces(const MechanicsModel& model, const Posterior& posterior,
                                            const std::vector<CheckedPress>& checks);

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

}  // namespace tacipc
