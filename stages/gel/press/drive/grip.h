// Poses of a gripped object and the fingers around it in frame 0, as bodies of a world.
#pragma once

#include <vector>

#include "stages/gel/press/drive/grasp_frame.h"
#include "stages/gel/press/world/world.h"

namespace tacipc {

/// Bodies of a grasp in the order left finger, right finger, object.
struct Grip {
  std::vector<Body> bodies;
  double start_gap_m = 0.0;    // distance of each finger from the object
  double start_width_m = 0.0;  // distance between the origins of both frames S
};

/// Rotates the object, moves its grip point to the origin, places the fingers next to it, and records mass, friction
/// and pose in `grasp`.
/// \param config the press configuration with the friction of the object
/// \throw UsageError if sensor or press file do not support grasps
/// \throw DataError if the object is not closed, or has no surface between the fingers
Grip make_grip(const Sensor& sensor, const TetMesh& gel, const TriangleMesh& object, const PressConfig& config,
               const GraspSpec& spec, Grasp& grasp);

}  // namespace tacipc
