// Energy and momentum of gels and bodies as a whole, and how they change in a time step of backward Euler.
//
// Call order: open_account() at the start, add_step() after each step, regroup() when bodies become held or free.
#pragma once

#include <vector>

#include "common/base/types.h"
#include "common/base/wrench.h"
#include "stages/gel/press/solve/rigid_motion.h"
#include "stages/gel/press/solve/time_step.h"

namespace tacipc {

/// A body at one instant. A held body belongs to the surroundings; only its height counts.
struct BodyInstant {
  const AffineBody* body;
  ControlPoints control;
  RigidMotion motion;
  bool held = false;
};

/// Gels and bodies at one instant, in the world.
struct WholeInstant {
  Positions gel_m, gel_velocity_m_s;  // one row per gel vertex
  std::vector<BodyInstant> bodies;
};

/// Forces at the end of a step, and energies exchanged in it.
struct StepExchange {
  double h_s = 0.0;
  Positions mount_n;         // mount forces at the end, one row per gel vertex, zero for vertices that are not glued
  Positions mount_before_n;  // mount forces at the start, likewise
  /// Wrench about the world's origin of the other external forces: held bodies and loads, without weight.
  Wrench others = {Vector3::Zero(), Vector3::Zero()};
  double others_work_j = 0.0;    // work of these in the step
  double elastic_j = 0.0;        // elastic energy of the gels at the end
  double contact_j = 0.0;        // barrier energy at the end
  double friction_loss_j = 0.0;  // energy dissipated by friction in the step
  double damping_loss_j = 0.0;   // energy dissipated by stiffness damping in the step
};

/// Exchange of a step as far as its forces determine it; `others` and `others_work_j` stay zero.
/// \param elastic_j elastic energy of the gels at the end
StepExchange exchange_of(double h_s, const StepForces& forces, const Positions& mount_before_n, double elastic_j);

/// Energies and momenta of the whole, and their exchange with the surroundings since the start.
///
/// Momentum: with v = Δx/h at the end of a step, Δ Σ m v = h (weight + mounts + others), as far as the step's forces
/// balance. The method adds h Σ m v_{n+1} × v_n to the angular momentum about the world's origin, summed over gel
/// vertices and centres of bodies; the spin of bodies is kept without this error. Two effects remain in the residual:
/// friction acts on two sides that are a gap apart, a couple of at most d̂ times its force, and stiffness damping is
/// not exactly invariant under rotation.
///
/// Energy: the work of mounts uses the mean of their forces at both ends of a step, which is accurate to second order
/// also if they rotate. The remainder `method_loss_j` = work − friction − damping − change of kinetic, elastic, contact
/// and gravitational energy is the dissipation of the method: about ½ Σ m |Δv|², and as much of the gels' vibrations.
/// For a viscoelastic gel it includes the energy that its viscous part stores and dissipates.
struct WholeAccount {
  double kinetic_j = 0.0;
  double elastic_j = 0.0;
  double contact_j = 0.0;
  double gravitational_j = 0.0;  // zero at the world's origin
  // Exchange since the start:
  double work_j = 0.0;  // work of mounts and others
  double friction_loss_j = 0.0;
  double damping_loss_j = 0.0;
  double method_loss_j = 0.0;

  Vector3 momentum_kg_m_s = Vector3::Zero();
  Vector3 angular_momentum_kg_m2_s = Vector3::Zero();
  // Exchange since the start:
  Vector3 impulse_n_s = Vector3::Zero();  // impulse of weight, mounts and others
  Vector3 angular_impulse_n_m_s = Vector3::Zero();
  Vector3 method_angular_n_m_s = Vector3::Zero();  // angular momentum added by the method

  // Largest |change / h − forces| of the steps since these were last set to zero.
  double momentum_residual_n = 0.0, angular_residual_n_m = 0.0;
};

/// Opens the account at the start. \param elastic_j elastic energy of the gels there
WholeAccount open_account(const Eigen::VectorXd& gel_mass_kg, const WholeInstant& start, const Vector3& gravity_m_s2,
                          double elastic_j);

/// Accounts for bodies that become held or free. The energy and momentum that they add or remove count as external work
/// and impulse.
/// \param now with the new states marked
void regroup(WholeAccount& account, const Eigen::VectorXd& gel_mass_kg, const WholeInstant& now,
             const Vector3& gravity_m_s2);

/// Adds a step.
/// \pre gels and bodies, and which of these are held, are the same before and after, and as in the last call of
/// open_account() or regroup()
void add_step(WholeAccount& account, const Eigen::VectorXd& gel_mass_kg, const WholeInstant& before,
              const WholeInstant& after, const Vector3& gravity_m_s2, const StepExchange& exchange);

}  // namespace tacipc
