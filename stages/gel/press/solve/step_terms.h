// Energy terms with which a time step starts: all except contact, friction and free bodies.
#pragma once

#include "stages/gel/press/solve/step_under_way.h"

namespace tacipc {

/// Adds inertia, damping, elasticity, gravity and stress relaxation of the gel, and the inertia and mount of an object
/// with free axes.
void add_terms(const SolverModel& model, const State& state, Step& step);

}  // namespace tacipc
