// An affine body: a practically rigid body described by four control points instead of all its vertices.
#pragma once

#include "common/base/types.h"
#include "common/base/wrench.h"

namespace tacipc {

using ControlPoints = Eigen::Matrix<double, 4, 3>;  // one row per control point

/// A body whose points are affine functions of four control points: x = Σₖ βₖ pₖ [Lan et al. 2022, there written as x =
/// c + A X].
///
/// Let S = Q Λ Qᵀ be the second moment, and tₖ the corners of a regular tetrahedron with Σ tₖ = 0 and Σ tₖ tₖᵀ = 4 I.
/// The control points at rest are pₖ = c + Q Λ^½ tₖ. Four particles of mass m/4 there have the body's mass, centre and
/// second moment. Its kinetic energy is therefore Σ ½ (m/4) |ṗₖ|² for every affine motion, and the mass matrix couples
/// no two points.
struct AffineBody {
  double mass_kg = 0.0;
  ControlPoints rest_m = ControlPoints::Zero();
  Eigen::Matrix<double, Eigen::Dynamic, 4> weights;  // β of each vertex; rows sum to 1
  Matrix3 rest_inertia_kg_m2 = Matrix3::Zero();      // inertia about the centre, in the axes of the rest positions
  double volume_m3 = 0.0;
};

/// Affine body of a solid of uniform density. If the centre of mass is shifted, the second moment about it equals that
/// of the solid about its own centre.
/// \param positions vertices at rest, in world axes
/// \param center_shift_m shift of the centre of mass from the solid's centre, in world axes
/// \throw DataError if the surface encloses no positive volume, or a solid without thickness
AffineBody make_affine_body(const Positions& positions, const Triangles& triangles, double density_kg_m3,
                            const Vector3& center_shift_m = Vector3::Zero());

/// Centre of mass: the mean of the control points.
inline Vector3 center_of(const ControlPoints& control) { return control.colwise().mean().transpose(); }

/// Gradients of the weights, 1/m: row k is gₖ = ∇βₖ = ¼ Q Λ^−½ tₖ, so that A = Σₖ pₖ gₖᵀ. The rows sum to zero.
ControlPoints weight_gradients(const AffineBody& body);

/// A of x = c + A (X − X_c), with c the mean of the control points.
Matrix3 deformation_of(const AffineBody& body, const ControlPoints& control);

/// Rotation R nearest to A: A = R U (polar decomposition).
Matrix3 rotation_of(const AffineBody& body, const ControlPoints& control);

/// Rigid motion x = c + R (X − X_c) from the rest positions, as 4 × 4 matrix.
Matrix4 pose_of(const AffineBody& body, const ControlPoints& control);

/// Control points of the undeformed shape with its centre at `center_m`, rotated by `rotation`.
ControlPoints rigid_points(const AffineBody& body, const Vector3& center_m, const Matrix3& rotation);

/// Largest entry of |AᵀA − I|: twice the largest entry of the strain.
double strain_of(const AffineBody& body, const ControlPoints& control);

/// Wrench Σ Fₖ and Σ (pₖ − c) × Fₖ of forces on the control points, about the centre of mass in world axes. Forces f on
/// vertices act on the control points as Fₖ = Σ βₖ f; the weights reproduce linear functions, so the wrench is the
/// same.
Wrench wrench_of(const ControlPoints& control, const ControlPoints& forces_n);

}  // namespace tacipc
