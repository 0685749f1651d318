// Augmented Lagrangian: holds glued and object vertices by multipliers instead of eliminating them.
#pragma once

#include <functional>

#include "stages/gel/press/solve/step_under_way.h"

namespace tacipc {

/// Adds the augmented Lagrangian that holds glued and object vertices at their targets.
void add_constraint(const SolverModel& model, Step& step);

/// Minimises and updates the multipliers in turn until all targets are met.
/// \param minimise brings the step's x to the minimum
/// \throw SolverError if a vertex stays away from its target
void minimise_constrained(Step& step, const std::function<void()>& minimise);

}  // namespace tacipc
