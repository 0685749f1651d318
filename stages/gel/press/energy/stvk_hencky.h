// St. Venant–Kirchhoff's energy in Hencky (logarithmic) strain.
#pragma once

#include "stages/gel/press/energy/principal_stretches.h"

namespace tacipc {

/// ψ(F) = μ tr ε² + λ/2 (tr ε)², ε = ln σ over the principal stretches σ, so tr ε = ln J; +∞ for J ≤ 0; in J/m³ for
/// μ, λ in Pa.   [Hencky 1928; the law of the paper's authors]
/// It does grow without bound as J → 0, but only like (ln J)²: a step that all but flattens a tetrahedron costs little,
/// so inversion must be kept away by the step limit as well. Its force against stretch falls off beyond ε = 1 (σ = e),
/// where the Hessian loses its definiteness for good.
struct StvkHencky {
  double mu_pa;
  double lambda_pa;

  /// ψ from the stretches.
  double principal_energy(const Vector3& sigma) const;
  /// First Piola–Kirchhoff stress, Pa. \pre det F > 0
  Matrix3 stress(const Matrix3& F) const;
  /// ψ̂_p = (2μ ε_p + λ tr ε)/σ_p, Pa: the stress in the principal frame.
  Vector3 principal_stress(const Vector3& sigma) const;
  /// ∂²ψ̂/∂σ_p∂σ_q = δ_pq (2μ − σ_p ψ̂_p)/σ_p² + λ/(σ_p σ_q); twist and flip as PrincipalTangent says. The flip's
  /// difference quotient is free of cancellation: with t = (σ_p − σ_q)/σ_q it is
  ///   [2μ (ln(1 + t)/t − ε_q) − λ tr ε]/(σ_p σ_q), ln(1 + t)/t → 1 for equal stretches.
  PrincipalTangent principal_tangent(const Vector3& sigma) const;
};

}  // namespace tacipc
