// Simulates a press: an object moves against the gel of one sensor as a sample prescribes.
#pragma once

#include "common/sample/sample_spec.h"
#include "common/sensor/sensor.h"
#include "stages/gel/press/drive/frame_run.h"
#include "stages/gel/press/world/world.h"

namespace tacipc {

/// Moves the object through all phases and returns the frames.
/// \param default_face side of the object that faces the gel if the sample does not name one
/// \param store storage for frames, from which an interrupted run resumes; null: none
/// \throw SolverError if a time step does not converge even after division
/// \throw VerdictError if a frame misses a limit (verdict.h)
/// \throw DataError if the object touches the gel at the start
Simulation simulate(const Sensor& sensor, const TetMesh& gel, const TriangleMesh& object, const PressConfig& config,
                    const SampleSpec& sample, const std::string& default_face, const ProgressObserver& observe,
                    FrameStore* store = nullptr);

}  // namespace tacipc
