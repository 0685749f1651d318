// Line search of Newton's method.
#pragma once

#include <optional>

#include "stages/gel/press/solve/solver_times.h"
#include "stages/gel/press/solve/step_under_way.h"

namespace tacipc {

/// Takes the longest of the steps limit, limit/2, … that decreases the energy.
/// \return the fraction of the direction taken; nothing if there is none, and then nothing moved
std::optional<double> line_search(const NewtonDirection& direction, double limit, Step& step, Minimisation& run,
                                  SolverTimes& times);

/// Raises the PSD shares of the vertices with the longest steps, the likely cause why the line search had to shorten
/// the step p.
void raise_shares_of_farthest(const Positions& p, Blend& blend);

/// √(max |row i|²) over the first `rows` rows.
double largest_row(const Positions& p, Eigen::Index rows);

}  // namespace tacipc
