// Singular values of a deformation gradient, and a Hessian over them.
#pragma once

#include "common/base/types.h"

namespace tacipc {

/// Factors F = U diag(σ) Vᵀ with rotations U, V and σ > 0, in no particular order.
struct PrincipalStretches {
  Matrix3 U;
  Vector3 sigma;
  Matrix3 V;
};

/// Computes the factors by one-sided Jacobi rotations: every σ is accurate to a few roundings and U is orthogonal,
/// however flat F is.
/// \pre det F > 0
PrincipalStretches principal_stretches(const Matrix3& F);

/// Hessian ∂²ψ/∂F² of an isotropic ψ = ψ̂(σ) in the principal frame [form of Smith et al. 2019]. With ψ̂_p = ∂ψ̂/∂σ_p,
/// its values over the directions are
///   u_p v_pᵀ                        the 3 × 3 block `stretch` = ∂²ψ̂/∂σ_p∂σ_q,
///   (u_p v_qᵀ − u_q v_pᵀ)/√2        `twist` (ψ̂_p + ψ̂_q)/(σ_p + σ_q),
///   (u_p v_qᵀ + u_q v_pᵀ)/√2        `flip`  (ψ̂_p − ψ̂_q)/(σ_p − σ_q).
/// Entry r of twist and flip is for the two axes p, q other than r.
struct PrincipalTangent {
  Matrix3 stretch;
  Vector3 twist, flip;

  /// Replaces it by the nearest positive semi-definite one, which is also nearest for the whole 9 × 9 Hessian.
  void project();
  /// Adds p ∂²J/∂F², J = det F: the energy ψ̂ gains p σ₀σ₁σ₂.
  void add_pressure(double pressure, const Vector3& sigma);
};

}  // namespace tacipc
