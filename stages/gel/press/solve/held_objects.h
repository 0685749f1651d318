// Objects that go where a step's goal takes them, and gels that move with their mounts.
#pragma once

#include "stages/gel/press/solve/step_under_way.h"

namespace tacipc {

/// Displacement of each point by a rigid motion.
Positions way_of(const Matrix4& motion, const Positions& from);

/// Whether objects that are not free are at their targets.
bool objects_arrived(const ContactMesh& mesh, const Step& step);
/// Displacement of objects that are not free from their rows of x to their targets; zero in all other rows.
Positions way_of_held_objects(const ContactMesh& mesh, const Step& step, const Positions& x);
/// Puts objects that are not free at their targets.
void place_held_objects(const ContactMesh& mesh, const Step& step, Positions& x);
/// Puts glued vertices where their mounts end.
void place_glued_vertices(const GelModel& gel, const StepGoal& goal, Positions& x);

}  // namespace tacipc
