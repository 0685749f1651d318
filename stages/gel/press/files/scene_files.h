// Reads the files that a scene names: meshes, materials and paths of its bodies.
#pragma once

#include <memory>
#include <vector>

#include "common/stage/stage.h"
#include "stages/gel/press/drive/scene_bodies.h"
#include "stages/gel/press/files/saved_frames.h"

namespace tacipc {

/// A scene with the contents of its files.
struct SceneFiles {
  SceneSpec spec;
  std::vector<SceneBody> bodies;  // contents of spec.bodies
  std::unique_ptr<FrameStore> frames;
};

/// Reads the scene of --sample with all files that it names, and records them as inputs.
/// \throw UsageError if a file is missing
/// \throw DataError if it cannot be read
SceneFiles read_scene(Stage& stage, const Sensor& sensor);

/// Text of the motion of each frame, from frame 0 on: displacements, holds and loads, but not paths.
std::vector<std::string> motion_by_frame(const SceneSpec& spec);

}  // namespace tacipc
