// A scene: gels on mounts, soft, rigid and fixed bodies, all in contact with each other.
#pragma once

#include "stages/gel/press/drive/frame_run.h"
#include "stages/gel/press/drive/scene_bodies.h"
#include "stages/gel/press/drive/scene_frame.h"

namespace tacipc {

/// \param bodies of spec.bodies, in that order
/// \throw as simulate()
Scene run_scene(const Sensor& sensor, const std::vector<SceneBody>& bodies, const PressConfig& config,
                const SceneSpec& spec, const ProgressObserver& observe, FrameStore* store = nullptr);

}  // namespace tacipc
