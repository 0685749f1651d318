// Initial positions of a time step's minimisation.
#pragma once

#include "stages/gel/press/solve/collision_detector.h"
#include "stages/gel/press/solve/step_under_way.h"

namespace tacipc {

/// Displaces gels with their mounts and free bodies along their flight, as far as contact allows.
void start_ahead(const SolverModel& model, CollisionDetector& detector, const State& state, Step& step);

/// Largest displacement of a vertex in p, relative to the mean displacement of the objects.
double relative_way(const ContactMesh& mesh, const Positions& p);
/// Largest relative displacement for which contact pairs are searched at once; longer ones are divided.
double longest_way(const StepSettings& settings);

}  // namespace tacipc
