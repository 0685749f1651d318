// Input of a time step: its goal (target poses, loads, mount motions) and the state at its start.
#pragma once

#include <vector>

#include "stages/gel/press/energy/viscoelasticity.h"
#include "stages/gel/press/solve/rigid_motion.h"

namespace tacipc {

/// Length, target poses, loads and mount motions of one time step.
struct StepGoal {
  double h_s = 0.0;
  Positions object_target;           // object vertices at the end; a shift along free_axes is added
  std::vector<int> free_axes = {};   // axes of S along which the object's translation is an unknown
  Vector3 load_n = Vector3::Zero();  // force on the object along free axes without a mount
  double object_mass_kg = 0.0;       // inertia of the object along these axes; > 0 if there are any
  /// Compliant mount: stiffness of a massless spring along each free axis, 0 along others. Its rest position is
  /// object_target − mount_shift_m, where a rigid mount would hold the object.
  Vector3 mount_stiffness_n_m = Vector3::Zero(), mount_shift_m = Vector3::Zero();
  /// True: bodies that are not in held_bodies translate and rotate freely, by weight, load and contact.
  /// \pre there are bodies
  bool free_object = false;
  std::vector<int> held_bodies = {};  // bodies that are held, ascending
  /// Load at each body's centre of mass, held or not. Empty: load_n acts on the only body.
  std::vector<Vector3> body_load_n = {};
  /// Gels that move with their mounts: displacement of each gel vertex by the mount's rigid motion, and target
  /// positions of the glued vertices in the order of GelModel::glued. Both empty: no mount moves.
  Positions gel_motion = {}, glued_target = {};
  /// Rigid motion in the world that all mounts share. A free object that their gels touch starts the step with it. If
  /// it rotates, friction and damping measure motion relative to it.
  Matrix4 hand_motion = Matrix4::Identity();
  std::vector<Matrix3> world_from_gel = {};  // orientation of each of several gels at the end; empty for one gel
  /// Rigid motion of each of several gels with its mount; identity for a body without a mount. Empty: all gels follow
  /// hand_motion.
  std::vector<Matrix4> mount_motion = {};
  /// Targets of the bodies' control points, as object_target is for vertices. Rows of free bodies are ignored.
  Positions control_target = {};
};

/// State that one time step passes to the next. Rows of x: gel vertices, object vertices, control points of bodies.
struct State {
  Positions x;
  Positions velocity_m_s;                                                // gel vertices
  Vector3 object_velocity_m_s = Vector3::Zero();                         // object velocity along the axes of a load
  std::vector<RigidMotion> object_motion = std::vector<RigidMotion>(1);  // one per object that may be free
  double barrier_factor = 1.0;               // factor on the barrier's stiffness in the next step
  Viscoelasticity::History viscous_pa = {};  // stress history of a viscoelastic gel
};

}  // namespace tacipc
