// Writes the outputs of a press, a grasp or a scene: arrays per frame and the summary of the record.
#pragma once

#include "common/stage/stage.h"
#include "stages/gel/press/drive/grasp_frame.h"
#include "stages/gel/press/drive/scene_bodies.h"
#include "stages/gel/press/drive/scene_frame.h"

namespace tacipc {

/// Writes every array of the press folder and the summary of the record.
void write_outputs(Stage& stage, const Sensor& sensor, const TetMesh& gel, const SampleSpec& sample,
                   const Simulation& simulation);

/// Writes a press folder of each finger in left/press and right/press, the motion of object and fingers in the world
/// next to them, and the summary of the record.
void write_outputs(Stage& stage, const Sensor& sensor, const TetMesh& gel, const Grasp& grasp);

/// Writes a press folder of each gel in gels/<name>/press, the motion of all bodies in the world and the wrenches
/// between them, and the summary of the record.
void write_outputs(Stage& stage, const Sensor& sensor, const std::vector<SceneBody>& bodies, const SceneSpec& spec,
                   const Scene& scene);

}  // namespace tacipc
