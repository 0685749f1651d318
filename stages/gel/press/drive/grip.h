// The pose of a gripped object and of the fingers around it in frame 0, as bodies of a world.
#pragma once

#include <vector>

#include "stages/gel/press/drive/grasp_frame.h"
#include "stages/gel/press/world/world.h"

namespace tacipc {

/// Left finger, right finger, object, in the order of the bodies.
struct Grip {
  std::vector<Body> bodies;
  double start_gap_m = 0.0;    // of each finger from the object
  double start_width_m = 0.0;  // between the origins of both frames S
};

/// Turns the object, hangs its grip point at the origin, puts the fingers beside it, and notes mass, friction and pose
/// in `grasp`.
/// \param config the press file with the friction of the object
/// \throw UsageError if sensor or press file are not made for grasps \throw DataError if the object is not closed, or
/// there is nothing of it between the fingers
Grip make_grip(const Sensor& sensor, const TetMesh& gel, const TriangleMesh& object, const PressConfig& config,
               const GraspSpec& spec, Grasp& grasp);

}  // namespace tacipc
