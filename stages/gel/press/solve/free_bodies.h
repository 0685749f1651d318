// Free bodies in a time step: their energy terms, and their momentum after the step.
#pragma once

#include <algorithm>

#include "stages/gel/press/solve/step_under_way.h"

namespace tacipc {

/// Predicts the flight of free bodies without contact, and adds their inertia and the energy that keeps their shape.
void add_free_bodies(const SolverModel& model, const State& state, Step& step);

/// Updates the momentum of all bodies after the step, and writes the largest imbalance of a free body into the report.
/// \param between contact wrenches at the end of the step (StepForces::between)
void finish_bodies(const SolverModel& model, const std::vector<Wrench>& between, Step& step, State& state);

}  // namespace tacipc
