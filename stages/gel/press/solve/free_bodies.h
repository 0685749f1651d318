// Bodies that move freely in a time step: their terms, and their momentum after it.
#pragma once

#include <algorithm>

#include "stages/gel/press/solve/step_under_way.h"

namespace tacipc {

/// Predicts where free bodies fly without contact, and adds their inertia and the energy that keeps their shape.
void add_free_bodies(const SolverModel& model, const State& state, Step& step);

/// Momentum of all bodies after the step, and in the step's report the largest imbalance of a free body.
/// \param between contact wrenches at the end of the step (StepForces::between)
void finish_bodies(const SolverModel& model, const std::vector<Wrench>& between, Step& step, State& state);

}  // namespace tacipc
