// St. Venant–Kirchhoff energy in Hencky (logarithmic) strain.
#pragma once

#include "stages/gel/press/energy/principal_stretches.h"

namespace tacipc {

/// Energy density ψ(F) = μ tr ε² + λ/2 (tr ε)², J/m³ for μ, λ in Pa, with ε = ln σ over the principal stretches σ, so
/// tr ε = ln J; +∞ for J ≤ 0 [Hencky 1928; the law of the paper's authors]. As J → 0 it grows without bound, but only
/// like (ln J)²: a step that almost flattens a tetrahedron costs little, so the step limit must also prevent inversion.
/// Its stress decreases with stretch beyond ε = 1 (σ = e), and its Hessian is indefinite from there on.
struct StvkHencky {
  double mu_pa;
  double lambda_pa;

  /// ψ as a function of the stretches.
  double principal_energy(const Vector3& sigma) const;
  /// First Piola–Kirchhoff stress, Pa. \pre det F > 0
  Matrix3 stress(const Matrix3& F) const;
  /// Principal stress ψ̂_p = (2μ ε_p + λ tr ε)/σ_p, Pa.
  Vector3 principal_stress(const Vector3& sigma) const;
  /// ∂²ψ̂/∂σ_p∂σ_q = δ_pq (2μ − σ_p ψ̂_p)/σ_p² + λ/(σ_p σ_q); twist and flip as in PrincipalTangent. The flip's
  /// difference quotient is computed without cancellation: with t = (σ_p − σ_q)/σ_q it is
  ///   [2μ (ln(1 + t)/t − ε_q) − λ tr ε]/(σ_p σ_q), ln(1 + t)/t → 1 for equal stretches.
  PrincipalTangent principal_tangent(const Vector3& sigma) const;
};

}  // namespace tacipc
