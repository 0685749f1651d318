// Energy and momentum of gels and bodies as a whole, and where a time step of backward Euler's method takes them from.
#pragma once

#include <vector>

#include "common/base/types.h"
#include "common/base/wrench.h"
#include "stages/gel/press/solve/rigid_motion.h"
#include "stages/gel/press/solve/time_step.h"

namespace tacipc {

/// A body at one instant. One that is held, or moved by a rule, belongs to what acts on the whole from outside; only
/// its height counts.
struct BodyInstant {
  const AffineBody* body;
  ControlPoints control;
  RigidMotion motion;
  bool held = false;
};

/// Gels and bodies at one instant, in the world.
struct WholeInstant {
  Positions gel_m, gel_velocity_m_s;  // a row per gel vertex
  std::vector<BodyInstant> bodies;
};

/// What a step ended with, and what it took.
struct StepExchange {
  double h_s = 0.0;
  Positions mount_n;         // force of the mounts at its end, a row per gel vertex, zero where none is
  Positions mount_before_n;  // the same at its start
  /// Force and torque about the world's origin of all others from outside: held bodies and loads, not the weight.
  Wrench others = {Vector3::Zero(), Vector3::Zero()};
  double others_work_j = 0.0;    // done by these in the step
  double elastic_j = 0.0;        // of the gels at its end
  double contact_j = 0.0;        // of the barrier at its end
  double friction_loss_j = 0.0;  // in the step
  double damping_loss_j = 0.0;
};

/// What a step's forces tell of it; the others are left out. \param elastic_j of the gels at its end
StepExchange exchange_of(double h_s, const StepForces& forces, const Positions& mount_before_n, double elastic_j);

/// Energies of the whole, what it has exchanged since the start, and its momentum.
///
/// Momentum: with v = Δx/h at the end of a step, Δ Σ m v = h (weight + mounts + others) as far as the step's forces
/// balance. Angular momentum about the world's origin besides gets h Σ m v_{n+1} × v_n from the method, of gel vertices
/// and centres of bodies; what bodies turn by is carried without that. Friction acts on two sides that are a gap apart,
/// which is a couple of at most d̂ times its force, and stiffness damping does not quite go along with a rotation: both
/// are left in the residual.
///
/// Energy: mounts do work by the mean of their forces at both ends of a step: to second order what the whole takes up,
/// where they turn, too. What the method takes, about ½ Σ m |Δv|² and as much of the gels' vibrations, is the remainder
/// `method_loss_j` = work − friction − damping − change of kinetic, elastic, contact and gravitational energy. Of a gel
/// whose stress relaxes that includes what its viscous part stores and loses.
struct WholeAccount {
  double kinetic_j = 0.0;
  double elastic_j = 0.0;
  double contact_j = 0.0;
  double gravitational_j = 0.0;  // from the world's origin
  // Since the start:
  double work_j = 0.0;  // of mounts and others
  double friction_loss_j = 0.0;
  double damping_loss_j = 0.0;
  double method_loss_j = 0.0;

  Vector3 momentum_kg_m_s = Vector3::Zero();
  Vector3 angular_momentum_kg_m2_s = Vector3::Zero();
  // Since the start:
  Vector3 impulse_n_s = Vector3::Zero();  // of weight, mounts and others
  Vector3 angular_impulse_n_m_s = Vector3::Zero();
  Vector3 method_angular_n_m_s = Vector3::Zero();

  // Largest |change / h − forces| of the steps since these were last set to zero.
  double momentum_residual_n = 0.0, angular_residual_n_m = 0.0;
};

/// The account of a start at rest or in motion. \param elastic_j of the gels there
WholeAccount open_account(const Eigen::VectorXd& gel_mass_kg, const WholeInstant& start, const Vector3& gravity_m_s2,
                          double elastic_j);

/// Bodies are held, or let go, that were not before: what they bring in or take away counts as work and impulse from
/// outside. \param now with the new ones marked
void regroup(WholeAccount& account, const Eigen::VectorXd& gel_mass_kg, const WholeInstant& now,
             const Vector3& gravity_m_s2);

/// Takes a step over. \pre gels and bodies are the same before and after, and were so when the account was opened
void add_step(WholeAccount& account, const Eigen::VectorXd& gel_mass_kg, const WholeInstant& before,
              const WholeInstant& after, const Vector3& gravity_m_s2, const StepExchange& exchange);

}  // namespace tacipc
