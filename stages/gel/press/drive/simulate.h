// A whole motion: frames of the gel under a moving object, each checked by code that shares nothing with the solver.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/mesh/tet_mesh.h"
#include "common/mesh/triangle_mesh.h"
#include "common/sample/sample_spec.h"
#include "common/sensor/sensor.h"
#include "stages/gel/press/contact/intersection_check.h"
#include "stages/gel/press/measure/balance.h"
#include "stages/gel/press/measure/contact_summary.h"
#include "stages/gel/press/measure/verdict.h"
#include "stages/gel/press/solve/time_step.h"
#include "stages/gel/press/world/press_config.h"

namespace tacipc {

/// One saved instant. Frame 0 is the gel at rest with the object out of the barrier's reach.
struct Frame {
  double time_s = 0.0;
  PhaseKind phase = PhaseKind::reference;
  int phase_index = -1;                       // into the sample's motion; −1 for frame 0
  Positions positions;                        // gel, m
  Matrix4 gel_from_object;                    // pose of the object
  Matrix4 holder_pose = Matrix4::Identity();  // the same on a rigid mount: what a prescribed motion prescribes
  Positions normal_force_n;                   // on each front vertex; gel on gel adds pairs that cancel
  Positions friction_force_n;                 // the same by friction
  std::vector<ContactState> contact_state;    // of each front vertex
  Vector3 force_n = Vector3::Zero();          // Σ on the gel by the object, wherever it touches
  Vector3 torque_n_m = Vector3::Zero();       // the same about the origin of S
  Balance balance;
  double min_gap_m = 0.0;    // gel–object, at most `gap_horizon_m`
  double stand_off_m = 0.0;  // mean gap where they press on each other, by force
  double min_volume_ratio = 1.0;
  double pose_error_m = 0.0;  // largest distance of an object vertex from where its pose puts it, unless it is free
  double body_strain = 0.0;   // of a free object: max |AᵀA − I|
  // Of an object that is free in any phase: of its centre of mass, and about it.
  Vector3 object_velocity_m_s = Vector3::Zero(), object_spin_rad_s = Vector3::Zero();
  int intersections = 0;       // pairs of triangles, by an exact test
  int inverted_tets = 0;       // the same
  double gel_in_object = 0.0;  // how many times a closed object's surface winds around the gel
  StepReport solver;
};

struct Simulation {
  double d_hat_m = 0.0;
  double barrier_stiffness = 0.0;  // κ, kg m⁻², before it grows (StepReport::barrier_factor)
  double gap_horizon_m = 0.0;      // gaps are looked for up to this distance
  double object_mass_kg = 0.0;     // 0 where the sample gives no density
  bool object_may_be_free = false;
  bool mount_gives_way = false;
  std::string face;
  FrontSurface front;
  std::string element;  // "linear", "averaged_volume"
  NewtonSettings newton;
  std::vector<Frame> frames;
  SolverTimes times;  // of this run, which may have found frames of an earlier one
  int symbolic_analyses = 0;
};

/// What of a frame is judged, and by which limits where `contact_force_n` (StepReport) is exchanged.
FrameNumbers numbers_of(const Frame& frame);
SolverLimits limits_of(const PressConfig& config, const NewtonSettings& newton, double contact_force_n);

using ProgressObserver = std::function<void(int frame, int num_frames, int iteration, double velocity_residual_m_s)>;

/// What a frame starts from.
struct Progress {
  State state;
  /// Of the object along its free axes since the start of the phase, or against where a rigid mount would have it.
  Vector3 object_shift_m = Vector3::Zero();
};

/// Keeps the frames of a motion as they are solved, so that an interrupted run resumes.
class FrameStore {
 public:
  virtual ~FrameStore() = default;
  /// Called after each frame, in order, with what the next one needs.
  virtual void save(const Frame& frame, const Progress& progress) = 0;
  /// The next saved frame in order, if there is one.
  virtual bool load(Frame& frame, Progress& progress) = 0;
};

/// Moves the object through its phases. \throw SolverError if a time step does not converge, VerdictError if a frame
/// misses a limit of verdict.h, DataError if the start is not free of contact.
Simulation simulate(const Sensor& sensor, const TetMesh& gel, const TriangleMesh& object, const PressConfig& config,
                    const SampleSpec& sample, const std::string& default_face, const ProgressObserver& observe,
                    FrameStore* store = nullptr);

}  // namespace tacipc
