// State that a time step starts from, and where its objects go.
#pragma once

#include <vector>

#include "stages/gel/press/energy/viscoelasticity.h"
#include "stages/gel/press/solve/rigid_motion.h"

namespace tacipc {

/// Where objects go in one step.
struct StepGoal {
  double h_s = 0.0;
  Positions object_target;           // of their vertices; along free axes, where they would be without any shift
  std::vector<int> free_axes = {};   // of S, along which the object moves as loads, its mount and contact have it
  Vector3 load_n = Vector3::Zero();  // on the object, along those without a mount
  double object_mass_kg = 0.0;       // its inertia along these; > 0 if there are any
  /// Of a mount that gives way, along free axes, 0 along others: a spring without mass pulls the object to where it
  /// would be on a rigid one, and object_target is already `mount_shift_m` past that.
  Vector3 mount_stiffness_n_m = Vector3::Zero(), mount_shift_m = Vector3::Zero();
  /// Bodies move and turn as their weight, the load at their centre of mass, and contact have it: nothing of them is
  /// prescribed. \pre there are bodies
  bool free_object = false;
  std::vector<int> held_bodies = {};      // but for these, ascending
  std::vector<Vector3> body_load_n = {};  // on each body, held or not; empty: load_n on the only one
  /// How gels go that are carried by their mounts: for each of their vertices the way it would go if the gel moved
  /// rigidly with its mount, and where glued vertices end, in the order of GelModel::glued. Empty: no mount moves.
  Positions gel_motion = {}, glued_target = {};
  /// What all mounts have in common, a rigid motion of the world: a free object that they hold starts from there, and
  /// where it turns, friction and damping count what is left of each motion beside it.
  Matrix4 hand_motion = Matrix4::Identity();
  std::vector<Matrix3> world_from_gel = {};  // how several gels are turned at its end; empty for one
  /// Rigid motion of each of several gels with its mount, the identity of a body without one; empty: hand_motion.
  std::vector<Matrix4> mount_motion = {};
  /// Of the bodies' points, as object_target is of their vertices; rows of those that are free do not matter.
  Positions control_target = {};
};

/// What moves; rows of gel, object, and the points that carry an object that may be free.
struct State {
  Positions x;
  Positions velocity_m_s;                                                // gel rows
  Vector3 object_velocity_m_s = Vector3::Zero();                         // along axes of a load
  std::vector<RigidMotion> object_motion = std::vector<RigidMotion>(1);  // of each object that may be free
  double barrier_factor = 1.0;                                           // on the barrier's stiffness in the next step
  Viscoelasticity::History viscous_pa = {};                              // of a gel whose stress relaxes
};

}  // namespace tacipc
