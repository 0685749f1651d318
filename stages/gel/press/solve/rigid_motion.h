// Motion of an affine body from step to step, stored as that of a rigid body: prediction of its flight, and update
// after a step.
#pragma once

#include "stages/gel/press/energy/affine_body.h"

namespace tacipc {

/// Motion of an affine body between steps. Implicit Euler with velocities of the control points would lose spin, dω/dt
/// = −h ω³, because control points fly straight; a rigid motion keeps it.
struct RigidMotion {
  Vector3 velocity_m_s = Vector3::Zero();              // velocity of the centre of mass
  Vector3 angular_momentum_kg_m2_s = Vector3::Zero();  // angular momentum about the centre of mass, world axes
};

/// Motion of a body with velocity v and angular velocity ω in world axes: L = R Iᵇ Rᵀ ω.
RigidMotion make_rigid_motion(const AffineBody& body, const ControlPoints& control, const Vector3& velocity_m_s,
                              const Vector3& angular_velocity_rad_s);

/// Control points p̂ after free flight for the time h: p̂ₖ = ĉ + R̂ (Xₖ − X_c), the rest shape without strain. The
/// centre is that of backward Euler, ĉ = c + h v + h² g, so gravity needs no term of its own in the step's energy. R̂
/// is the body's rotation (polar decomposition of its deformation) after torque-free rotation: L is constant and R
/// changes by ω = R (Iᵇ)⁻¹ Rᵀ L. The classical Runge–Kutta method on unit quaternions integrates it, in 2 to 8 substeps
/// of at most 0.025 rad, up to 0.2 rad in all.
ControlPoints predicted(const AffineBody& body, const ControlPoints& control, const RigidMotion& motion,
                        const Vector3& gravity_m_s2, double h_s);

/// Motion after a step that ended at `control` instead of the predicted points. With Dₖ = (pₖ − p̂ₖ)/h, v ← v + h g +
/// mean D and L ← L + (m/4) Σ (pₖ − c) × Dₖ. At the minimum of ½ Σ (m/4) ‖pₖ − p̂ₖ‖² + h² (all other energies) the
/// changes are h times the forces and torques at the end of the step.
RigidMotion after_step(const AffineBody& body, const ControlPoints& predicted_points, const ControlPoints& control,
                       const RigidMotion& before, const Vector3& gravity_m_s2, double h_s);

/// Angular velocity ω = R (Iᵇ)⁻¹ Rᵀ L in rad/s, world axes.
Vector3 angular_velocity(const AffineBody& body, const ControlPoints& control, const RigidMotion& motion);

/// Kinetic energy ½ m |v|² + ½ ω · L in J.
double kinetic_energy(const AffineBody& body, const ControlPoints& control, const RigidMotion& motion);

}  // namespace tacipc
