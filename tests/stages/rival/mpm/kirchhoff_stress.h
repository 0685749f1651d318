// The law of one particle in double precision, against which tests hold the packed one.
#pragma once

#include "stages/rival/mpm/fixed_corotated.h"

namespace tacipc {

/// τ = P Fᵀ = 2 μ (F − R) Fᵀ + λ J (J − 1) I with J = det F.
inline Matrix3 kirchhoff_stress(const Matrix3& F, double mu, double lambda) {
  const double J = F.determinant();
  return 2.0 * mu * (F - nearest_rotation(F)) * F.transpose() + lambda * J * (J - 1.0) * Matrix3::Identity();
}

}  // namespace tacipc
