// How stiff the barrier is where the configuration does not give κ: as the gel beneath it.
#pragma once

namespace tacipc {

/// What a contact vertex of the gel is like.
struct GelScale {
  double h_s = 0.0;                // time step
  double youngs_modulus_pa = 0.0;  // E
  double front_edge_m = 0.0;       // ℓ, the front's median edge
  double d_hat_m = 0.0;
};

/// κ = c h² E ℓ² / d̂³ in kg m⁻². At a given d/d̂ a pair pushes with about κ d̂³/h² (from ∂/∂d of κ/h² b(d²), b of
/// barrier.h), and it takes about E ℓ² to press one vertex of the gel in: their ratio c is the same for any gel, mesh
/// and d̂.
inline double balanced_barrier_stiffness(double relative_stiffness, const GelScale& gel) {
  const double h = gel.h_s, l = gel.front_edge_m, d = gel.d_hat_m;
  return relative_stiffness * h * h * gel.youngs_modulus_pa * l * l / (d * d * d);
}

}  // namespace tacipc
