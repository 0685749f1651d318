// Simulates a scene: gels on mounts, soft, rigid and fixed bodies in contact with each other.
#pragma once

#include "stages/gel/press/drive/frame_run.h"
#include "stages/gel/press/drive/scene_bodies.h"
#include "stages/gel/press/drive/scene_frame.h"

namespace tacipc {

/// Runs all phases of a scene.
/// \param bodies contents of spec.bodies, in that order
/// \throw SolverError, VerdictError, DataError as simulate()
Scene run_scene(const Sensor& sensor, const std::vector<SceneBody>& bodies, const PressConfig& config,
                const SceneSpec& spec, const ProgressObserver& observe, FrameStore* store = nullptr);

}  // namespace tacipc
