// Reports fits of several simulations and assumptions as a table, vectors as CSV.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "stages/study/marker_fit/fit_field.h"

namespace tacipc {

/// One line of the table: an assumption or a simulator, and its fit or the reason why it has none.
struct FitRow {
  std::string name;
  std::optional<FieldFit> fit = std::nullopt;
  std::string no_fit = {};
};

/// Markdown table. Two lines follow the rows: the errors of vectors of zero length, and of the first row's own vectors
/// rounded to whole pixels, which is the resolution of the measurement.
/// \pre the first row has a fit
std::string fit_table(const std::vector<FitRow>& rows, const MeasuredPressAndShear& measured,
                      const MarkerBenchmark& benchmark);

/// Text that compares the errors of each simulator's press and shear vectors with those of the first.
/// \pre the first has a fit
std::string comparison_text(const std::vector<FitRow>& simulators);

/// CSV of each marker of press and shear, columns
/// field,x_px,y_px,measured_dx_px,measured_dy_px,simulated_dx_px,simulated_dy_px.
std::string vectors_csv(const FieldFit& fit, const MeasuredPressAndShear& measured);

}  // namespace tacipc
