// A whole motion: frames of the gel under a moving object, each checked by code that shares nothing with the solver.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/sensor.h"
#include "common/tet_mesh.h"
#include "common/triangle_mesh.h"
#include "stages/press/placement.h"
#include "stages/press/press_config.h"
#include "stages/press/solve/time_step.h"

namespace tacipc {

/// One saved instant. Frame 0 is the gel at rest with the object out of the barrier's reach.
struct Frame {
  Positions positions;                      // gel, m
  Matrix4 gel_from_object;                  // pose of the object
  Positions contact_force;                  // on each gel vertex by contact, N; gel on gel adds pairs that cancel
  Vector3 force_n = Vector3::Zero();        // Σ on the gel by the object
  Vector3 torque_n_m = Vector3::Zero();     // the same about the origin of S
  Vector3 mount_force_n = Vector3::Zero();  // Σ on the gel by its mount
  double min_gap_m = 0.0;                   // gel–object, at most `gap_horizon_m`
  double min_volume_ratio = 1.0;
  StepReport solver;
};

struct Simulation {
  double d_hat_m = 0.0;
  double gap_horizon_m = 0.0;  // gaps are looked for up to this distance
  std::string face;
  std::vector<Frame> frames;
  int symbolic_analyses = 0;
};

using ProgressObserver = std::function<void(int frame, int num_frames, int iteration, double velocity_residual_m_s)>;

/// Presses the object into the gel. \throw SolverError if a frame does not converge or fails its check, DataError if
/// the start is not free of contact.
Simulation simulate(const Sensor& sensor, const TetMesh& gel, const TriangleMesh& object, const PressConfig& config,
                    const SampleSpec& sample, const std::string& default_face, const ProgressObserver& observe);

}  // namespace tacipc
