// Held objects, whose poses a step prescribes, and gels that move with their mounts.
#pragma once

#include "stages/gel/press/solve/step_under_way.h"

namespace tacipc {

/// Displacement of each point of `from` by a rigid motion.
Positions way_of(const Matrix4& motion, const Positions& from);

/// Whether all held objects are at their targets.
bool objects_arrived(const ContactMesh& mesh, const Step& step);
/// Displacement of held objects from their rows of x to their targets; zero in all other rows.
Positions way_of_held_objects(const ContactMesh& mesh, const Step& step, const Positions& x);
/// Sets the rows of held objects to their targets.
void place_held_objects(const ContactMesh& mesh, const Step& step, Positions& x);
/// Sets the glued vertices to their targets.
void place_glued_vertices(const GelModel& gel, const StepGoal& goal, Positions& x);

}  // namespace tacipc
