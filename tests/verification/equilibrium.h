// A plain Newton solver over single coordinates, beside the press's own: for patch tests and energy tests of its terms.
#pragma once

#include <vector>

#include "stages/gel/press/energy/incremental_potential.h"

namespace tacipc::verify {

/// Minimises Σ weight × term over the coordinates of x (#V × 3, row-major) that `fixed` (3 × #V) does not hold where
/// they are; starts from x. Newton with the exact Hessian, its PSD projection where that is not a descent, and
/// backtracking. Ends when the largest step is below `tolerance_m`. \throw SolverError after `max_iterations`
void find_equilibrium(const std::vector<WeightedTerm>& terms, const std::vector<bool>& fixed, double tolerance_m,
                      Positions& x, int max_iterations = 200);

/// Gradient of the sum at every coordinate.
Positions total_gradient(const std::vector<WeightedTerm>& terms, const Positions& x);
double total_value(const std::vector<WeightedTerm>& terms, const Positions& x);

}  // namespace tacipc::verify
