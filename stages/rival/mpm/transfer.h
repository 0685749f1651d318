// Transfers between particles and nodes: MLS-MPM with APIC velocities and quadratic B-splines, one tile at a time.
// [Hu et al. 2018, Jiang et al. 2015]
#pragma once

#include <array>

#include "stages/rival/mpm/particle_pack.h"
#include "stages/rival/mpm/slab.h"

namespace tacipc {

/// Elastic constants in cells and steps: 4 Δt² μ / (ρ Δx²) and 4 Δt² λ / (ρ Δx²). The 4 / Δx² is the inverse of the
/// quadratic B-spline's second moment; particle volume and mass cancel to 1 / ρ.
struct StepMaterial {
  float mu = 0.0f;
  float lambda = 0.0f;
};

/// A point of the object during one step.
struct MovingPoint {
  std::array<float, 3> position;  // position from the slab's origin, cells
  std::array<float, 3> velocity;  // cells per step
};

/// Adds momentum and mass of the packs to the slab: w_ip (v + A (x_i − x_p)), A = C − (4 Δt² / (ρ Δx²)) τ.
void scatter(const ParticlePack* packs, int num_packs, const StepMaterial& material, Slab& slab);

/// Adds points without stress and affine velocity, each with the mass of `mass` gel particles.
void scatter(const MovingPoint* points, int num_points, float mass, Slab& slab);

/// Converts momentum to velocity (times `keep`) in columns first … last − 1; nodes without mass and held nodes rest.
void update_nodes(Slab& slab, std::size_t first, std::size_t last, float keep);

/// Result of gather.
struct GatherReport {
  float largest_speed_squared = 0.0f;  // (cells per step)²; infinite if a number is not finite
};

/// Updates particles: v = Σ w v_i, C = 4 Σ w v_i (x_i − x_p)ᵀ, F ← (I + C) F, x ← x + v. Particles with an id below
/// `num_fixed` have v = 0 and stay.
GatherReport gather(ParticlePack* packs, int num_packs, const Slab& slab, int num_fixed);

}  // namespace tacipc
