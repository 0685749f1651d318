// Simulates a grasp: two gels on their mounts, and an object between them that is free once they have closed on it.
#pragma once

#include "stages/gel/press/drive/frame_run.h"
#include "stages/gel/press/drive/grasp_frame.h"

namespace tacipc {

/// Runs all phases of a grasp. \throw SolverError, VerdictError, DataError as simulate()
Grasp grasp(const Sensor& sensor, const TetMesh& gel, const TriangleMesh& object, const PressConfig& config,
            const GraspSpec& spec, const ProgressObserver& observe, FrameStore* store = nullptr);

}  // namespace tacipc
