// Compressible neo-Hookean material: density of elastic energy over the deformation gradient.
#pragma once

#include "common/base/types.h"

namespace tacipc {

/// Energy density Ψ(F) = μ/2 (tr FᵀF − 3) − μ ln J + λ/2 (ln J)², J = det F > 0, J/m³ for μ, λ in Pa [Bonet & Wood
/// 1997, 6.4.3]. With a = μ − λ ln J: P = ∂Ψ/∂F = μ F − a F⁻ᵀ, and for a change δF
///   δP = μ δF + a F⁻ᵀ δFᵀ F⁻ᵀ + λ (F⁻ᵀ : δF) F⁻ᵀ.
struct NeoHookean {
  double mu_pa;
  double lambda_pa;

  /// First Piola–Kirchhoff stress P, Pa. \pre det F > 0
  Matrix3 stress(const Matrix3& F) const;
};

/// Direction Q in the space of F along which ∂²Ψ/∂F² is negative: ∂²Ψ : Q ⊗ Q = value < 0, ‖Q‖ = 1.
struct NegativeMode {
  double value;
  Matrix3 Q;
};

/// Computes the modes whose removal makes ∂²(Ψ + p J)/∂F² positive semi-definite.
///
/// In the principal frame F = U diag(σ) Vᵀ the Hessian splits into independent parts [form of Smith et al. 2019 for
/// isotropic energies], with α = a − p J and β = λ + p J:
/// - three twists (u_p v_qᵀ − u_q v_pᵀ)/√2 with the value μ − α/(σ_p σ_q),
/// - three flips (u_p v_qᵀ + u_q v_pᵀ)/√2 with the value μ + α/(σ_p σ_q),
/// - a 3 × 3 block δ_pq (μ + α/σ_p²) + β/(σ_p σ_q) over the stretches u_p v_pᵀ.
///
/// \param pressure pressure term p, positive in tension
/// \return number of modes, at most six
int negative_modes(const NeoHookean& material, const Matrix3& F, double pressure, NegativeMode modes[6]);

}  // namespace tacipc
