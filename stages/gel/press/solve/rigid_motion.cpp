#include "stages/gel/press/solve/rigid_motion.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace tacipc {
namespace {

constexpr double kSubstepRad = 0.025;  // the Runge–Kutta error of such a rotation is below 10⁻¹⁰ rad
constexpr int kFewestSubsteps = 2, kMostSubsteps = 8;

/// R T Rᵀ a: a tensor in the body's axes, applied to a vector in world axes.
Vector3 turned(const Matrix3& rotation, const Matrix3& tensor, const Vector3& vector) {
  return rotation * (tensor * (rotation.transpose() * vector));
}

/// R after a torque-free rotation for the time h.
Matrix3 turned_freely(const Matrix3& start, const Matrix3& inverse_inertia, const Vector3& momentum, double h_s) {
  const double angle = h_s * turned(start, inverse_inertia, momentum).norm();
  // Limited before the conversion to int: an absurd angle would not fit.
  const double wanted = std::min(1.0 * kMostSubsteps, std::max(1.0 * kFewestSubsteps, std::ceil(angle / kSubstepRad)));
  const int substeps = static_cast<int>(wanted);
  const double step = h_s / substeps;
  using Coefficients = Eigen::Vector4d;  // order x, y, z, w
  // q̇ = ½ ω q. The q of a stage is not exactly of unit length; its rotation is.
  const auto rate = [&](const Coefficients& q) -> Coefficients {
    const Vector3 half = 0.5 * turned(Eigen::Quaterniond(q).normalized().toRotationMatrix(), inverse_inertia, momentum);
    return (Eigen::Quaterniond(0.0, half.x(), half.y(), half.z()) * Eigen::Quaterniond(q)).coeffs();
  };
  Coefficients q = Eigen::Quaterniond(start).coeffs();
  for (int i = 0; i < substeps; ++i) {
    const Coefficients k1 = rate(q);
    const Coefficients k2 = rate(q + 0.5 * step * k1);
    const Coefficients k3 = rate(q + 0.5 * step * k2);
    const Coefficients k4 = rate(q + step * k3);
    q = (q + step / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)).normalized();
  }
  return Eigen::Quaterniond(q).toRotationMatrix();
}

}  // namespace

RigidMotion make_rigid_motion(const AffineBody& body, const ControlPoints& control, const Vector3& velocity_m_s,
                              const Vector3& angular_velocity_rad_s) {
  return {velocity_m_s, turned(rotation_of(body, control), body.rest_inertia_kg_m2, angular_velocity_rad_s)};
}

ControlPoints predicted(const AffineBody& body, const ControlPoints& control, const RigidMotion& motion,
                        const Vector3& gravity_m_s2, double h_s) {
  const Vector3 center = center_of(control) + h_s * motion.velocity_m_s + h_s * h_s * gravity_m_s2;
  return rigid_points(body, center,
                      turned_freely(rotation_of(body, control), body.rest_inertia_kg_m2.inverse(),
                                    motion.angular_momentum_kg_m2_s, h_s));
}

RigidMotion after_step(const AffineBody& body, const ControlPoints& predicted_points, const ControlPoints& control,
                       const RigidMotion& before, const Vector3& gravity_m_s2, double h_s) {
  const ControlPoints impulse = 0.25 * body.mass_kg / h_s * (control - predicted_points);
  const Wrench total = wrench_of(control, impulse);
  return {before.velocity_m_s + h_s * gravity_m_s2 + total.force_n / body.mass_kg,
          before.angular_momentum_kg_m2_s + total.torque_n_m};
}

Vector3 angular_velocity(const AffineBody& body, const ControlPoints& control, const RigidMotion& motion) {
  return turned(rotation_of(body, control), body.rest_inertia_kg_m2.inverse(), motion.angular_momentum_kg_m2_s);
}

double kinetic_energy(const AffineBody& body, const ControlPoints& control, const RigidMotion& motion) {
  return 0.5 * body.mass_kg * motion.velocity_m_s.squaredNorm() +
         0.5 * angular_velocity(body, control, motion).dot(motion.angular_momentum_kg_m2_s);
}

}  // namespace tacipc
