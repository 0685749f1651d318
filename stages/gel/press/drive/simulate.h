// A press: the gel of one sensor at rest, and an object that a sample's motion moves against it.
#pragma once

#include "common/sample/sample_spec.h"
#include "common/sensor/sensor.h"
#include "stages/gel/press/drive/frame_run.h"
#include "stages/gel/press/world/world.h"

namespace tacipc {

/// Moves the object through its phases. \throw SolverError if a time step does not converge, VerdictError if a frame
/// misses a limit of verdict.h, DataError if the start is not free of contact.
Simulation simulate(const Sensor& sensor, const TetMesh& gel, const TriangleMesh& object, const PressConfig& config,
                    const SampleSpec& sample, const std::string& default_face, const ProgressObserver& observe,
                    FrameStore* store = nullptr);

}  // namespace tacipc
