// An affine body's motion from step to step, kept as a rigid body's: where it would fly, and what the step changed.
#pragma once

#include "stages/gel/press/energy/affine_body.h"

namespace tacipc {

/// What an affine body's motion is carried on by from step to step. Implicit Euler that carries velocities of the
/// control points would lose spin, dω/dt = −h ω³, because these fly straight; a rigid body keeps it.
struct RigidMotion {
  Vector3 velocity_m_s = Vector3::Zero();              // of the centre of mass
  Vector3 angular_momentum_kg_m2_s = Vector3::Zero();  // about the centre of mass, world axes
};

/// The motion of a body that moves by v and turns by ω, world axes: L = R Iᵇ Rᵀ ω.
RigidMotion make_rigid_motion(const AffineBody& body, const ControlPoints& control, const Vector3& velocity_m_s,
                              const Vector3& angular_velocity_rad_s);

/// Control points p̂ after h of free flight: p̂ₖ = ĉ + R̂ (Xₖ − X_c), the rest shape without strain. The centre is
/// backward Euler's, ĉ = c + h v + h² g, so gravity is no term of its own in the step's energy. R̂ is the body's
/// rotation (polar decomposition of its deformation) after turning without torque: L stays, R changes by ω = R (Iᵇ)⁻¹
/// Rᵀ L, integrated by the classical Runge–Kutta method on unit quaternions in 2 to 8 substeps of at most 0.025 rad up
/// to 0.2 rad in all.
ControlPoints predicted(const AffineBody& body, const ControlPoints& control, const RigidMotion& motion,
                        const Vector3& gravity_m_s2, double h_s);

/// The motion after the step that ended at `control` instead of the predicted points: with Dₖ = (pₖ − p̂ₖ)/h,
/// v ← v + h g + mean D and L ← L + (m/4) Σ (pₖ − c) × Dₖ. At the minimum of ½ Σ (m/4) ‖pₖ − p̂ₖ‖² + h² (all else) these
/// are h times the forces and torques at the end of the step.
RigidMotion after_step(const AffineBody& body, const ControlPoints& predicted_points, const ControlPoints& control,
                       const RigidMotion& before, const Vector3& gravity_m_s2, double h_s);

/// ω = R (Iᵇ)⁻¹ Rᵀ L in rad/s, world axes.
Vector3 angular_velocity(const AffineBody& body, const ControlPoints& control, const RigidMotion& motion);

/// ½ m |v|² + ½ ω · L in J.
double kinetic_energy(const AffineBody& body, const ControlPoints& control, const RigidMotion& motion);

}  // namespace tacipc
