// Frame of one gel: the saved instant with all its measured quantities.
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

/// One saved instant of a gel, in its own frame S. Frame 0 is the gel at rest with all objects outside the range of the
/// barrier.
struct Frame {
  double time_s = 0.0;
  PhaseKind phase = PhaseKind::reference;
  int phase_index = -1;                           // index into the sample's motion; −1 for frame 0
  Positions positions;                            // gel vertices, m
  Matrix4 gel_from_object = Matrix4::Identity();  // pose of the object
  Matrix4 holder_pose = Matrix4::Identity();      // pose of the object on a rigid mount: the prescribed motion
  Positions normal_force_n;                 // contact force on each front vertex; gel–gel pairs cancel in the sum
  Positions friction_force_n;               // friction on each front vertex
  std::vector<ContactState> contact_state;  // state of each front vertex
  Vector3 force_n = Vector3::Zero();        // total contact force on the gel, wherever the object touches
  Vector3 torque_n_m = Vector3::Zero();     // total contact torque about the origin of S
  Balance balance;
  std::optional<double> min_gap_m;  // between gel and object; absent beyond Scales::gap_horizon_m
  double stand_off_m = 0.0;         // force-weighted mean gap
  double min_volume_ratio = 1.0;
  double pose_error_m = 0.0;  // largest distance of an object vertex from its prescribed position; 0 for a free object
  double body_strain = 0.0;   // free object: max |AᵀA − I|
  // Object that is free in any phase: velocity of the centre of mass, and angular velocity.
  Vector3 object_velocity_m_s = Vector3::Zero(), object_spin_rad_s = Vector3::Zero();
  int intersections = 0;       // intersecting pairs of triangles, by an exact test
  int inverted_tets = 0;       // inverted tetrahedra, by an exact test
  double gel_in_object = 0.0;  // winding number of a closed object's surface around the gel
  SymmetricRows stress_pa;     // Cauchy stress of each tetrahedron if the configuration asks for it; else no rows
  StepReport solver;
};

/// Whether anything touches the gel.
inline bool touches(const Frame& frame) { return frame.force_n.norm() > kTouches_n; }

/// Text of a gap, such as "5.21 um"; "-" if absent.
std::string gap_text(const std::optional<double>& gap_m);

/// All frames of one gel, and quantities that are constant over them.
struct Simulation {
  double friction = 0.0, d_hat_m = 0.0;  // between gel and object
  double barrier_stiffness = 0.0;        // initial κ, kg m⁻²; StepReport::barrier_factor multiplies it
  double object_mass_kg = 0.0;           // 0 if the sample gives no density
  bool object_may_be_free = false;
  bool mount_gives_way = false;  // the sensor's mount is compliant
  std::string face;              // side of the object that faces the gel
  FrontSurface front;
  std::string element;  // "linear" or "averaged_volume"
  NewtonSettings newton;
  std::vector<Frame> frames;
  SolverTimes times;  // solver times of this run; frames restored from an earlier one are not included
};

/// Numbers of a frame that the verdict judges.
FrameNumbers numbers_of(const Frame& frame);
/// Solver limits of a frame. \param contact_force_n StepReport::contact_force_n
SolverLimits limits_of(const PressConfig& config, const NewtonSettings& newton, double contact_force_n);

/// Called after each Newton iteration of each frame.
using ProgressObserver = std::function<void(int frame, int num_frames, int iteration, double velocity_residual_m_s)>;

}  // namespace tacipc
