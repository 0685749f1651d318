// Fits of several simulations and assumptions as a table, vectors as CSV.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "stages/study/marker_fit/fit_field.h"

namespace tacipc {

/// One line of the table: what was assumed, or which simulator, and the fit or why there is none.
struct FitRow {
  std::string name;
  std::optional<FieldFit> fit = std::nullopt;
  std::string no_fit = {};
};

/// Markdown. Below the rows stand the errors of vectors of no length, and of the first row's own vectors rounded to
/// whole pixels, which is how they were measured. \pre the first row has a fit
std::string fit_table(const std::vector<FitRow>& rows, const MeasuredPressAndShear& measured,
                      const MarkerBenchmark& benchmark);

/// In words, how far each simulator's vectors of press and shear are from the measured ones, beside the first's.
/// \pre the first has a fit
std::string comparison_text(const std::vector<FitRow>& simulators);

/// field,x_px,y_px,measured_dx_px,measured_dy_px,simulated_dx_px,simulated_dy_px for each marker of press and shear.
std::string vectors_csv(const FieldFit& fit, const MeasuredPressAndShear& measured);

}  // namespace tacipc
