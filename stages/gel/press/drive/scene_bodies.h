// Conversion of the bodies of a scene to bodies of a world.
#pragma once

#include <vector>

#include "stages/gel/press/drive/scene_spec.h"
#include "stages/gel/press/world/world.h"

namespace tacipc {

/// Contents of the files of one body.
struct SceneBody {
  TetMesh tets = {};               // gel, soft
  Material material = {};          // gel, soft
  TriangleMesh surface = {};       // rigid, fixed
  std::vector<Matrix4> path = {};  // gel, rigid with a path: world_from_body at the start and after each time step
};

/// Bodies of the world.
/// \param files contents of spec.bodies, in that order
/// \throw UsageError if sensor or press file do not support scenes
/// \throw DataError that names a body whose surface is not closed or whose path does not fit the motion
std::vector<Body> scene_bodies(const Sensor& sensor, const std::vector<SceneBody>& files, const PressConfig& config,
                               const SceneSpec& spec);

/// Contact of each pair of bodies, from press file, sensor and scene.
PairContact scene_contact(const Sensor& sensor, const PressConfig& config, const SceneSpec& spec);

}  // namespace tacipc
