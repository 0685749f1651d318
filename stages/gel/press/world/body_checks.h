// Checks between bodies: exact intersections, containment and initial gaps, by code independent of the solver.
#pragma once

#include <string>
#include <vector>

#include "stages/gel/press/contact/contact_laws.h"

namespace tacipc {

/// A body at one instant, in the world. Two fixed bodies may share points.
struct BodyShape {
  const std::string& name;
  Positions positions;
  const Triangles& triangles;
  bool deformable = false;
  bool fixed = false;  // not free to move
  bool closed = true;  // encloses a volume in which another body may lie
};

/// Checks the path of a body.
/// \throw DataError unless it has a pose for the start and for the end of each time step and never rotates too far in
/// one step
void check_path(const std::string& name, const std::vector<Matrix4>& path, int time_steps);

/// Tests exactly for intersections between bodies and within each deformable body, and for bodies inside a closed one.
/// \return intersecting pairs of triangles; the limit allows none
/// \throw VerdictError that names the bodies
int judge_bodies(int frame, const std::vector<BodyShape>& bodies);

/// Checks the start. \throw DataError that names two bodies that intersect, or are within the range of contact
void require_apart(const std::vector<BodyShape>& bodies, const ContactLaws& laws);

}  // namespace tacipc
