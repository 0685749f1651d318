// Positions that a time step starts its search for the minimum from.
#pragma once

#include "stages/gel/press/solve/collision_detector.h"
#include "stages/gel/press/solve/step_under_way.h"

namespace tacipc {

/// Moves gels with their mounts and free bodies along their flight, or as far as contact allows.
void start_ahead(const SolverModel& model, CollisionDetector& detector, const State& state, Step& step);

/// Largest displacement of a vertex in p relative to the mean of the objects'.
double relative_way(const ContactMesh& mesh, const Positions& p);
/// Largest relative displacement along which pairs are searched at once.
double longest_way(const StepSettings& settings);

}  // namespace tacipc
