// Unrecorded depth and travel of a ball from the marker vectors they caused, and the residuals.
#pragma once

#include <optional>
#include <string>

#include "common/benchmark/marker_benchmark.h"
#include "common/benchmark/measured_field.h"
#include "common/benchmark/pressed_runs.h"

namespace tacipc {

/// How far simulated vectors u are from measured ones m, px.
struct FieldErrors {
  int markers = 0;
  double mean_px = 0.0;  // of the end-point error |u − m|
  double median_px = 0.0;
  double max_px = 0.0;
  int directions = 0;      // measured vectors long enough to have one
  double angle_deg = 0.0;  // mean angle between u and m over those
  double ratio = 0.0;      // Σ|u| / Σ|m|
};

/// `left_out` is a marker that does not count. \pre as many columns in both
FieldErrors field_errors(const Eigen::Matrix2Xd& simulated, const Eigen::Matrix2Xd& measured, double least_length_px,
                         std::optional<Eigen::Index> left_out);

/// What was measured, as the fit sees it.
struct MeasuredPressAndShear {
  MarkerField press, shear;       // medians removed where the benchmark says so
  Eigen::Index shear_marker = 0;  // of `shear`: the one that the travel is fitted to

  /// \throw DataError if no marker rests within 1 px of `shear_marker_px`
  MeasuredPressAndShear(MarkerField press_field, MarkerField shear_field, const MarkerBenchmark& benchmark);
};

struct FieldFit {
  double depth_m = 0.0;
  std::string depth_end = {};  // "the shallowest" or "the deepest" that is sheared, if one beyond it might fit better
  double way_m = 0.0;
  double way_missed_px = 0.0;           // by how much the fitted marker is still off
  Eigen::Matrix2Xd press_px, shear_px;  // simulated, at the measured markers
  FieldErrors press, shear;             // of the shear without the marker that was fitted
};

/// The depth is the one of 1001 even ones up to the deepest press whose vectors are nearest to the measured press
/// (least squares over all markers); the travel is the one of 1001 up to the longest shear that brings the chosen
/// marker nearest to where it was measured. A median that was removed from measured vectors is removed from simulated
/// ones too. \throw DataError if the travel is the longest one simulated, or the depth beyond those that are sheared
/// and the nearest of them is not to be taken
FieldFit fit_field(const PressedRuns& runs, const MeasuredPressAndShear& measured, const MarkerAssumptions& assumed,
                   const MarkerBenchmark& benchmark, bool take_ends = false);

}  // namespace tacipc
