// Outputs of a press, a grasp or a scene: arrays per frame and the numbers of its record.
#pragma once

#include "common/stage/stage.h"
#include "stages/gel/press/drive/grasp_frame.h"
#include "stages/gel/press/drive/scene_bodies.h"
#include "stages/gel/press/drive/scene_frame.h"

namespace tacipc {

/// Every array of the press folder, and the summary of the record.
void write_outputs(Stage& stage, const Sensor& sensor, const TetMesh& gel, const SampleSpec& sample,
                   const Simulation& simulation);

/// A press folder of each finger in left/press and right/press, the motion of object and fingers in the world beside
/// them, and the summary of the record.
void write_outputs(Stage& stage, const Sensor& sensor, const TetMesh& gel, const Grasp& grasp);

/// A press folder of each gel in gels/<name>/press, the motion of all bodies in the world and the wrenches between them
/// beside these, and the summary of the record.
void write_outputs(Stage& stage, const Sensor& sensor, const std::vector<SceneBody>& bodies, const SceneSpec& spec,
                   const Scene& scene);

}  // namespace tacipc
