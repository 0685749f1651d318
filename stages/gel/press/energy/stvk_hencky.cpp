#include "stages/gel/press/energy/stvk_hencky.h"

#include <cmath>

namespace tacipc {

double StvkHencky::principal_energy(const Vector3& sigma) const {
  const Vector3 strain = sigma.array().log();
  const double trace = strain.sum();
  return mu_pa * strain.squaredNorm() + 0.5 * lambda_pa * trace * trace;
}

Vector3 StvkHencky::principal_stress(const Vector3& sigma) const {
  const Vector3 strain = sigma.array().log();
  return (2.0 * mu_pa * strain.array() + lambda_pa * strain.sum()) / sigma.array();
}

Matrix3 StvkHencky::stress(const Matrix3& F) const {
  const PrincipalStretches s = principal_stretches(F);
  return s.U * principal_stress(s.sigma).asDiagonal() * s.V.transpose();
}

PrincipalTangent StvkHencky::principal_tangent(const Vector3& sigma) const {
  const Vector3 strain = sigma.array().log(), stress = principal_stress(sigma), inverse = sigma.cwiseInverse();
  const double pressure = lambda_pa * strain.sum();
  PrincipalTangent out{lambda_pa * inverse * inverse.transpose(), {}, {}};
  for (int r = 0; r < 3; ++r) {
    out.stretch(r, r) += (2.0 * mu_pa - sigma[r] * stress[r]) * inverse[r] * inverse[r];
    const int p = (r + 1) % 3, q = (r + 2) % 3;
    const double t = (sigma[p] - sigma[q]) / sigma[q];
    const double log_quotient = t == 0.0 ? 1.0 : std::log1p(t) / t;
    out.twist[r] = (stress[p] + stress[q]) / (sigma[p] + sigma[q]);
    out.flip[r] = (2.0 * mu_pa * (log_quotient - strain[q]) - pressure) * inverse[p] * inverse[q];
  }
  return out;
}

}  // namespace tacipc
