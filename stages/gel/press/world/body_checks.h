// Checks between bodies: exact intersections, containment and initial gaps, by code that shares nothing with the
// solver.
#pragma once

#include <string>
#include <vector>

#include "stages/gel/press/contact/contact_laws.h"

namespace tacipc {

/// A body at one instant, in the world. Two that are fixed may share points.
struct BodyShape {
  const std::string& name;
  Positions positions;
  const Triangles& triangles;
  bool deformable = false;
  bool fixed = false;  // does not move freely
  bool closed = true;  // encloses a volume in which another body may lie
};

/// \throw DataError if a body's path has not a pose for the start and for the end of each time step, or turns too far
/// in one
void check_path(const std::string& name, const std::vector<Matrix4>& path, int time_steps);

/// Tests exactly for intersections between bodies and of each deformable one with itself, and whether one is inside
/// another that is closed. \return pairs of triangles that intersect, of which the limit allows none
/// \throw VerdictError naming the bodies
int judge_bodies(int frame, const std::vector<BodyShape>& bodies);

/// \throw DataError naming two bodies that intersect where they begin, or are as near as contact reaches
void require_apart(const std::vector<BodyShape>& bodies, const ContactLaws& laws);

}  // namespace tacipc
