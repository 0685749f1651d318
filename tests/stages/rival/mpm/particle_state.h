// Single particles of a gel in SI units, as tests set and read them.
#pragma once

#include <vector>

#include "stages/rival/mpm/material_points.h"

namespace tacipc {

struct ParticleState {
  Vector3 shift_m = Vector3::Zero();
  Vector3 velocity_m_s = Vector3::Zero();
  Matrix3 velocity_gradient_per_s = Matrix3::Zero();
  Matrix3 deformation = Matrix3::Identity();
};

/// By id.
inline std::vector<ParticleState> states_of(const MaterialPoints& points) {
  const MpmSetup& setup = points.setup();
  std::vector<ParticleState> states(points.num_particles());
  for (const ParticlePack& pack : points.packs()) {
    for (int l = 0; l < kParticleLanes && pack.id[l] >= 0; ++l) {
      ParticleState& state = states[pack.id[l]];
      for (int r = 0; r < 3; ++r) {
        state.shift_m[r] = setup.grid_spacing_m * static_cast<double>(pack.shift[r][l]);
        state.velocity_m_s[r] = setup.grid_spacing_m / setup.step_s * static_cast<double>(pack.velocity[r][l]);
        for (int c = 0; c < 3; ++c) {
          state.velocity_gradient_per_s(r, c) = static_cast<double>(pack.affine[3 * r + c][l]) / setup.step_s;
          state.deformation(r, c) = static_cast<double>(pack.deformation[3 * r + c][l]);
        }
      }
    }
  }
  return states;
}

/// \pre a state for each id
inline void set_states(MaterialPoints& points, const std::vector<ParticleState>& states) {
  const MpmSetup& setup = points.setup();
  std::vector<ParticlePack> packs = points.packs();
  for (ParticlePack& pack : packs) {
    for (int l = 0; l < kParticleLanes && pack.id[l] >= 0; ++l) {
      const ParticleState& state = states[pack.id[l]];
      for (int r = 0; r < 3; ++r) {
        pack.shift[r][l] = static_cast<float>(state.shift_m[r] / setup.grid_spacing_m);
        pack.velocity[r][l] = static_cast<float>(state.velocity_m_s[r] * setup.step_s / setup.grid_spacing_m);
        for (int c = 0; c < 3; ++c) {
          pack.affine[3 * r + c][l] = static_cast<float>(state.velocity_gradient_per_s(r, c) * setup.step_s);
          pack.deformation[3 * r + c][l] = static_cast<float>(state.deformation(r, c));
        }
      }
    }
  }
  points.set_packs(std::move(packs));
}

}  // namespace tacipc
