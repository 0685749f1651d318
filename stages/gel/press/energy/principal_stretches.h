// Singular values of a deformation gradient, and a Hessian over them.
#pragma once

#include "common/base/types.h"

namespace tacipc {

/// F = U diag(σ) Vᵀ with rotations U, V and σ > 0 (in no particular order).
struct PrincipalStretches {
  Matrix3 U;
  Vector3 sigma;
  Matrix3 V;
};

/// One-sided Jacobi rotations: every σ to a few roundings of itself, and U orthogonal, however flat F is. \pre det F >
/// 0
PrincipalStretches principal_stretches(const Matrix3& F);

/// ∂²ψ/∂F² of an isotropic ψ = ψ̂(σ) in the principal frame. With ψ̂_p = ∂ψ̂/∂σ_p, over the directions
///   u_p v_pᵀ                        the 3 × 3 block `stretch` = ∂²ψ̂/∂σ_p∂σ_q,
///   (u_p v_qᵀ − u_q v_pᵀ)/√2        `twist` (ψ̂_p + ψ̂_q)/(σ_p + σ_q),
///   (u_p v_qᵀ + u_q v_pᵀ)/√2        `flip`  (ψ̂_p − ψ̂_q)/(σ_p − σ_q),
/// entry r of twist and flip for the two axes p, q other than r.   [form of Smith et al. 2019]
struct PrincipalTangent {
  Matrix3 stretch;
  Vector3 twist, flip;

  /// Nearest positive semi-definite one, which is that of the whole 9 × 9 Hessian.
  void project();
  /// Adds p ∂²J/∂F², J = det F: ψ̂ gains p σ₀σ₁σ₂.
  void add_pressure(double pressure, const Vector3& sigma);
};

}  // namespace tacipc
