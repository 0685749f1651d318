// Compares forces and marker vectors of the fitted mechanics with measured ones, fitted or held out.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "stages/study/identify/fit.h"

namespace tacipc {

/// Predicted force of a press to a depth.
struct ForcePrediction {
  std::string measurement;
  double depth_mm = 0.0;
  bool fitted = false;
  double force_n = 0.0;              // force at the mean of the draws
  double parameter_sigma = 0.0;      // standard deviation of the draws, N
  double model_sigma = 0.0;          // change by the checks, N
  double low_n = 0.0, high_n = 0.0;  // 95 % interval of a measurement: parameters, model, and its own error
  std::optional<double> measured_n = std::nullopt;

  bool covered() const { return measured_n && *measured_n >= low_n && *measured_n <= high_n; }
};

/// One check for one measurement of a press: the force at the middle node over its depths, without and with the check.
struct CheckedPress {
  std::string check;
  std::size_t measurement = 0;
  CurveTable table;  // rows: without the check, with it
};

/// Relative change of a press's force at a depth of its table by the checks, without the mean change at the fitted
/// rows, which acts as a change of the modulus. Root of the sum of squares over the checks.
double model_error(const std::vector<CheckedPress>& checks, const MechanicsModel& model, std::size_t measurement,
                   double depth_mm);
/// Change of ln(force) by each check: the mean over the fitted rows of each press, then over the presses. The modulus
/// changes by the same amount in the opposite direction.
std::map<std::string, double> modulus_error(const std::vector<CheckedPress>& checks, const MechanicsModel& model);

/// Predictions for every row of every press and for the depths of Measurement::predict_mm without a row, ascending.
std::vector<ForcePrediction> predict_forces(const MechanicsModel& model, const Posterior& posterior,
                                            const std::vector<CheckedPress>& checks);

/// Errors of the vectors of a photograph, fitted or predicted: their number, the mean lengths of the measured vectors
/// and of the error, px, and the fraction of coordinates inside their 95 % interval.
struct MarkerErrors {
  std::string photograph;
  bool fitted = false;
  int vectors = 0;
  double measured_px = 0.0, error_px = 0.0, inside = 0.0;
};
/// Marker errors of press and shear, by measurement: fitted, then predicted, each half of the markers by a fit to the
/// other half.
std::map<std::size_t, std::vector<MarkerErrors>> all_marker_errors(MechanicsModel& model, const Posterior& posterior);

}  // namespace tacipc
