// Estimates the unrecorded depth and travel of a ball from the marker vectors they caused, and the residuals.
#pragma once

#include <optional>
#include <string>

#include "common/benchmark/marker_benchmark.h"
#include "common/benchmark/measured_field.h"
#include "common/benchmark/pressed_runs.h"

namespace tacipc {

/// Errors of simulated vectors u against measured ones m, px.
struct FieldErrors {
  int markers = 0;
  double mean_px = 0.0;  // mean end-point error |u − m|
  double median_px = 0.0;
  double max_px = 0.0;
  int directions = 0;      // number of measured vectors that are long enough to have a direction
  double angle_deg = 0.0;  // mean angle between u and m over these vectors
  double ratio = 0.0;      // Σ|u| / Σ|m|
};

/// Computes the errors.
/// \pre as many columns in both
/// \param left_out marker that does not count
FieldErrors field_errors(const Eigen::Matrix2Xd& simulated, const Eigen::Matrix2Xd& measured, double least_length_px,
                         std::optional<Eigen::Index> left_out);

/// Measured fields in the form the fit uses.
struct MeasuredPressAndShear {
  MarkerField press, shear;       // fields, without their medians if the benchmark removes these
  Eigen::Index shear_marker = 0;  // marker of `shear` to which the travel is fitted

  /// \throw DataError if no marker rests within 1 px of `shear_marker_px`
  MeasuredPressAndShear(MarkerField press_field, MarkerField shear_field, const MarkerBenchmark& benchmark);
};

/// Fitted depth and travel, and the remaining errors.
struct FieldFit {
  double depth_m = 0.0;
  std::string depth_end =
      {};  // "the shallowest" or "the deepest" depth with a shear, if a depth beyond it might fit better
  double way_m = 0.0;
  double way_missed_px = 0.0;           // remaining distance of the fitted marker
  Eigen::Matrix2Xd press_px, shear_px;  // simulated vectors at the measured markers
  FieldErrors press, shear;             // errors; for the shear without the fitted marker
};

/// Fits depth and travel. The depth is one of 1001 even values up to the deepest press: the one whose vectors are
/// nearest to the measured press (least squares over all markers). The travel is one of 1001 values up to the longest
/// shear: the one that brings the chosen marker nearest to its measured position. If the median was removed from
/// measured vectors, it is also removed from simulated ones.
/// \param take_ends accept the nearest simulated depth if the fit lies beyond the depths with a shear
/// \throw DataError if the travel is the longest simulated one, or the depth lies beyond those with a shear and
/// `take_ends` is false
FieldFit fit_field(const PressedRuns& runs, const MeasuredPressAndShear& measured, const MarkerAssumptions& assumed,
                   const MarkerBenchmark& benchmark, bool take_ends = false);

}  // namespace tacipc
