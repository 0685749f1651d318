// The fixed corotated law.   [Stomakhin et al. 2012]
#pragma once

#include "common/base/types.h"
#include "stages/rival/mpm/lanes.h"

namespace tacipc {

/// Rotation R = U Vᵀ of F = U Σ Vᵀ, where U and V are rotations, so that an inverted F has one negative singular value.
/// Defined for every finite F.
/// \throw nothing
Matrix3 nearest_rotation(const Matrix3& F);

/// Cofactors of a 3 × 3 matrix, row-major, and its determinant: F⁻ᵀ = cof F / det F.
TACIPC_INLINE Lanes cofactors(const Lanes* f, Lanes* cof) {
  cof[0] = f[4] * f[8] - f[5] * f[7];
  cof[1] = f[5] * f[6] - f[3] * f[8];
  cof[2] = f[3] * f[7] - f[4] * f[6];
  cof[3] = f[2] * f[7] - f[1] * f[8];
  cof[4] = f[0] * f[8] - f[2] * f[6];
  cof[5] = f[1] * f[6] - f[0] * f[7];
  cof[6] = f[1] * f[5] - f[2] * f[4];
  cof[7] = f[2] * f[3] - f[0] * f[5];
  cof[8] = f[0] * f[4] - f[1] * f[3];
  return f[0] * cof[0] + f[1] * cof[1] + f[2] * cof[2];
}

/// Least determinant for the iteration; smaller ones use the singular value decomposition.
constexpr float kSmallestDeterminant = 1e-3f;

/// Rotations R of sixteen F with det F ≥ kSmallestDeterminant (the identity in other lanes), by Newton's iteration R ←
/// ½ (R + R⁻ᵀ), which averages every singular value and its inverse.   [Higham 1986]
TACIPC_INLINE void rotations(const Lanes* F, const Lanes& determinant, Lanes* R) {
  constexpr int kMaxIterations = 20;
  // A step of length δ leaves an error of δ²/2, which is below float precision here.
  constexpr float kSmallStepSquared = 2e-7f;
  for (int i = 0; i < 9; ++i) R[i] = determinant > kSmallestDeterminant ? F[i] : all_lanes(i % 4 == 0 ? 1.0f : 0.0f);
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    Lanes cof[9];
    const Lanes inverse = 0.5f / cofactors(R, cof);
    Lanes step = {};
    for (int i = 0; i < 9; ++i) {
      const Lanes next = 0.5f * R[i] + inverse * cof[i];
      step += (next - R[i]) * (next - R[i]);
      R[i] = next;
    }
    if (!(largest_of(step) > kSmallStepSquared)) break;
  }
}

/// Kirchhoff stresses τ of sixteen particles.
TACIPC_INLINE void kirchhoff_stresses(const Lanes* F, float mu, float lambda, Lanes* tau) {
  Lanes cof[9], R[9];
  const Lanes J = cofactors(F, cof);
  rotations(F, J, R);
  for (int l = 0; l < kParticleLanes; ++l) {
    if (J[l] > kSmallestDeterminant) continue;
    Matrix3 inverted;
    for (int i = 0; i < 9; ++i) inverted(i / 3, i % 3) = static_cast<double>(F[i][l]);
    const Matrix3 rotation = nearest_rotation(inverted);
    for (int i = 0; i < 9; ++i) R[i][l] = static_cast<float>(rotation(i / 3, i % 3));
  }
  const Lanes volume = lambda * J * (J - 1.0f);
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) {
      Lanes sum = {};
      for (int k = 0; k < 3; ++k) sum += (F[3 * r + k] - R[3 * r + k]) * F[3 * c + k];
      tau[3 * r + c] = 2.0f * mu * sum;
      if (r == c) tau[3 * r + c] += volume;
    }
  }
}

}  // namespace tacipc
