#include "stages/gel/press/energy/affine_body.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>

#include "common/base/error.h"
#include "common/mesh/mass_properties.h"

namespace tacipc {
namespace {

/// Rows tₖ: every other corner of the cube [−1, 1]³.
ControlPoints tetrahedron() {
  ControlPoints t;
  t << 1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1;
  return t;
}

}  // namespace

AffineBody make_affine_body(const Positions& positions, const Triangles& triangles, double density_kg_m3,
                            const Vector3& center_shift_m) {
  if (!(density_kg_m3 > 0.0))
    throw DataError("a body's density is {:.3g} kg/m³, expected a positive one", density_kg_m3);
  const MassProperties solid = mass_properties(positions, triangles);
  require_solid(solid.second_moment_m2);
  const Eigen::SelfAdjointEigenSolver<Matrix3> eigen(solid.second_moment_m2);
  const Matrix3& axes = eigen.eigenvectors();
  const Vector3 radii = eigen.eigenvalues().cwiseSqrt(), center = solid.center_m + center_shift_m;

  AffineBody body;
  body.mass_kg = density_kg_m3 * solid.volume_m3;
  body.volume_m3 = solid.volume_m3;
  body.rest_inertia_kg_m2 = inertia_tensor(body.mass_kg, solid.second_moment_m2);
  body.rest_m = tetrahedron() * radii.asDiagonal() * axes.transpose();
  body.rest_m.rowwise() += center.transpose();
  // βₖ(X) = ¼ (1 + tₖ · Λ^−½ Qᵀ (X − c))
  const Positions scaled = (positions.rowwise() - center.transpose()) * axes * radii.cwiseInverse().asDiagonal();
  body.weights = (0.25 * (scaled * tetrahedron().transpose()).array() + 0.25).matrix();
  return body;
}

ControlPoints weight_gradients(const AffineBody& body) {
  // As in a tetrahedron: the inverse of the edges from the first point has the gradients of the other three weights.
  Matrix3 edges;
  for (int k = 0; k < 3; ++k) edges.col(k) = body.rest_m.row(k + 1) - body.rest_m.row(0);
  ControlPoints gradients;
  gradients.bottomRows<3>() = edges.inverse();
  gradients.row(0) = -gradients.bottomRows<3>().colwise().sum();
  return gradients;
}

Matrix3 deformation_of(const AffineBody& body, const ControlPoints& control) {
  // Relative to one of the points, so that a position far from the origin loses no digits.
  return (control.rowwise() - control.row(0)).transpose() * weight_gradients(body);
}

Matrix3 rotation_of(const AffineBody& body, const ControlPoints& control) {
  const Eigen::JacobiSVD<Matrix3> svd(deformation_of(body, control), Eigen::ComputeFullU | Eigen::ComputeFullV);
  Matrix3 U = svd.matrixU();
  // A mirrored body is rotated as far as a rotation can: its least singular direction stays mirrored.
  if (U.determinant() * svd.matrixV().determinant() < 0.0) U.col(2) *= -1.0;
  return U * svd.matrixV().transpose();
}

Matrix4 pose_of(const AffineBody& body, const ControlPoints& control) {
  const Matrix3 R = rotation_of(body, control);
  Matrix4 pose = Matrix4::Identity();
  pose.topLeftCorner<3, 3>() = R;
  pose.topRightCorner<3, 1>() = center_of(control) - R * center_of(body.rest_m);
  return pose;
}

ControlPoints rigid_points(const AffineBody& body, const Vector3& center_m, const Matrix3& rotation) {
  const ControlPoints arms = body.rest_m.rowwise() - center_of(body.rest_m).transpose();
  return (arms * rotation.transpose()).rowwise() + center_m.transpose();
}

double strain_of(const AffineBody& body, const ControlPoints& control) {
  const Matrix3 A = deformation_of(body, control);
  return (A.transpose() * A - Matrix3::Identity()).cwiseAbs().maxCoeff();
}

Wrench wrench_of(const ControlPoints& control, const ControlPoints& forces_n) {
  const Vector3 center = center_of(control);
  Wrench wrench{Vector3::Zero(), Vector3::Zero()};
  for (int k = 0; k < 4; ++k) {
    const Vector3 force = forces_n.row(k), arm = control.row(k).transpose() - center;
    wrench.force_n += force;
    wrench.torque_n_m += arm.cross(force);
  }
  return wrench;
}

}  // namespace tacipc
