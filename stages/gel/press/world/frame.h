// A frame of one gel: the instant that is saved, with everything that was measured of it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/base/symmetric_rows.h"
#include "common/sample/motion.h"
#include "stages/gel/press/measure/balance.h"
#include "stages/gel/press/measure/front_surface.h"
#include "stages/gel/press/measure/verdict.h"
#include "stages/gel/press/solve/time_step.h"
#include "stages/gel/press/world/press_config.h"

namespace tacipc {

/// One saved instant of a gel, in its own frame S. Frame 0 is the gel at rest with all objects out of the barrier's
/// reach.
struct Frame {
  double time_s = 0.0;
  PhaseKind phase = PhaseKind::reference;
  int phase_index = -1;                           // into the sample's motion; −1 for frame 0
  Positions positions;                            // gel, m
  Matrix4 gel_from_object = Matrix4::Identity();  // pose of the object
  Matrix4 holder_pose = Matrix4::Identity();      // the same on a rigid mount: the prescribed motion
  Positions normal_force_n;                       // on each front vertex; gel on gel adds pairs that cancel
  Positions friction_force_n;                     // friction on each front vertex
  std::vector<ContactState> contact_state;        // of each front vertex
  Vector3 force_n = Vector3::Zero();              // Σ on the gel by the object, wherever it touches
  Vector3 torque_n_m = Vector3::Zero();           // the same about the origin of S
  Balance balance;
  std::optional<double> min_gap_m;  // between gel and object; nothing beyond Scales::gap_horizon_m
  double stand_off_m = 0.0;         // force-weighted mean gap
  double min_volume_ratio = 1.0;
  double pose_error_m = 0.0;  // largest distance of an object vertex from its pose; 0 for a free object
  double body_strain = 0.0;   // max |AᵀA − I| of a free object
  // Velocity of the centre of mass and angular velocity of an object that is free in any phase.
  Vector3 object_velocity_m_s = Vector3::Zero(), object_spin_rad_s = Vector3::Zero();
  int intersections = 0;       // pairs of triangles, by an exact test
  int inverted_tets = 0;       // by an exact test
  double gel_in_object = 0.0;  // winding number of a closed object's surface around the gel
  SymmetricRows stress_pa;     // Cauchy stress of each tetrahedron, where the configuration wants it; else no rows
  StepReport solver;
};

/// Whether anything touches the gel.
inline bool touches(const Frame& frame) { return frame.force_n.norm() > kTouches_n; }

/// "5.21 um", or "-" for none.
std::string gap_text(const std::optional<double>& gap_m);

/// All frames of one gel, and what holds for each of them.
struct Simulation {
  double friction = 0.0, d_hat_m = 0.0;  // of the gel with the object
  double barrier_stiffness = 0.0;        // κ, kg m⁻², before it grows (StepReport::barrier_factor)
  double object_mass_kg = 0.0;           // 0 if the sample gives no density
  bool object_may_be_free = false;
  bool mount_gives_way = false;
  std::string face;
  FrontSurface front;
  std::string element;  // "linear", "averaged_volume"
  NewtonSettings newton;
  std::vector<Frame> frames;
  SolverTimes times;  // of this run, which may have found frames of an earlier one
};

/// The numbers of a frame that the verdict judges.
FrameNumbers numbers_of(const Frame& frame);
/// The limits of a frame in which forces of `contact_force_n` (StepReport) are exchanged.
SolverLimits limits_of(const PressConfig& config, const NewtonSettings& newton, double contact_force_n);

using ProgressObserver = std::function<void(int frame, int num_frames, int iteration, double velocity_residual_m_s)>;

}  // namespace tacipc
