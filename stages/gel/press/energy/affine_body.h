// A practically rigid body as an affine one: four control points instead of all its vertices.
#pragma once

#include "common/base/types.h"
#include "common/base/wrench.h"

namespace tacipc {

using ControlPoints = Eigen::Matrix<double, 4, 3>;  // one row each

/// A body whose every point is an affine function of four control points: x = Σₖ βₖ pₖ [Lan et al. 2022, there written
/// as x = c + A X]. With S = Q Λ Qᵀ the second moment and tₖ the corners of a regular tetrahedron, Σ tₖ = 0 and
/// Σ tₖ tₖᵀ = 4 I, the points are pₖ = c + Q Λ^½ tₖ at rest. Four particles of mass m/4 there have the body's mass,
/// centre and second moment: its kinetic energy is Σ ½ (m/4) |ṗₖ|² for every affine motion, without a mass between
/// different points.
struct AffineBody {
  double mass_kg = 0.0;
  ControlPoints rest_m = ControlPoints::Zero();
  Eigen::Matrix<double, Eigen::Dynamic, 4> weights;  // β of each vertex; rows sum to 1
  Matrix3 rest_inertia_kg_m2 = Matrix3::Zero();      // about the centre, in the axes of the rest positions
  double volume_m3 = 0.0;
};

/// A solid of uniform density, or one whose centre of mass lies beside that of the solid: its second moment about it is
/// that of the solid about its own.
/// \param positions vertices at rest, in world axes
/// \param center_shift_m from the solid's centre, in the same axes
/// \throw DataError if the surface encloses no positive volume, or a solid without thickness
AffineBody make_affine_body(const Positions& positions, const Triangles& triangles, double density_kg_m3,
                            const Vector3& center_shift_m = Vector3::Zero());

/// Centre of mass: the mean of the control points.
inline Vector3 center_of(const ControlPoints& control) { return control.colwise().mean().transpose(); }

/// Gradients of the weights, 1/m: row k is gₖ = ∇βₖ = ¼ Q Λ^−½ tₖ, so that A = Σₖ pₖ gₖᵀ. The rows sum to zero.
ControlPoints weight_gradients(const AffineBody& body);

/// A of x = c + A (X − X_c), with c the mean of the control points.
Matrix3 deformation_of(const AffineBody& body, const ControlPoints& control);

/// The rotation nearest to A, R of A = R U (polar decomposition).
Matrix3 rotation_of(const AffineBody& body, const ControlPoints& control);

/// Rigid motion from the rest positions to now, x = c + R (X − X_c), as 4×4.
Matrix4 pose_of(const AffineBody& body, const ControlPoints& control);

/// Control points of the rest shape, unstrained, with its centre at `center_m` and turned by `rotation`.
ControlPoints rigid_points(const AffineBody& body, const Vector3& center_m, const Matrix3& rotation);

/// max |AᵀA − I|: twice the largest entry of the strain.
double strain_of(const AffineBody& body, const ControlPoints& control);

/// Σ Fₖ and Σ (pₖ − c) × Fₖ of forces on the control points, about the centre of mass in world axes. Forces on vertices
/// come to the control points as Fₖ = Σ βₖ f; since the weights reproduce linear functions, the wrench is the same.
Wrench wrench_of(const ControlPoints& control, const ControlPoints& forces_n);

}  // namespace tacipc
