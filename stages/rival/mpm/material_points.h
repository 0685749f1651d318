// The gel as material points, and the object that moves through their grid.
#pragma once

#include <optional>
#include <vector>

#include "common/base/types.h"
#include "stages/rival/mpm/tile_order.h"
#include "stages/rival/mpm/transfer.h"

namespace tacipc {

/// Parameters of the scheme, SI units, frame S.
struct MpmSetup {
  double grid_spacing_m = 0.0;
  Vector3 grid_origin_m = Vector3::Zero();  // position of a grid node
  double step_s = 0.0;
  double mu_pa = 0.0;
  double lambda_pa = 0.0;
  double density_kg_m3 = 0.0;
  double particle_volume_m3 = 0.0;
  int num_fixed = 0;                                  // number of particles, from id 0, that never move
  std::optional<double> held_below_m = std::nullopt;  // height, m, at or below which grid nodes never move
  double damping_per_s = 0.0;                         // factor in v ← v (1 − Δt · damping) on the grid
  double object_mass_ratio = 1.0;                     // mass of a point of the object over that of a particle

  /// Speed of pressure waves √((λ + 2 μ) / ρ), m/s.
  double wave_speed_m_s() const;
  double particle_mass_kg() const { return density_kg_m3 * particle_volume_m3; }
};

/// State of the simulation.
class MaterialPoints {
 public:
  /// Particles at `rest_m`, at rest; row i has id i.
  /// \pre at least one
  MaterialPoints(const Positions& rest_m, const MpmSetup& setup);

  /// Places the object's points (own frame, m) where the first step begins. They move as a rigid body and move the grid
  /// with them: no slip, no stress.
  void place_object(const Positions& points_m, const Matrix4& gel_from_object);

  /// Computes one step, in which the object moves to `gel_from_object`.
  /// \throw SolverError if a particle moves half a cell in it, or a particle is no longer finite
  void step(const Matrix4& gel_from_object);
  /// Computes one step with the object at rest.
  void step() { step(gel_from_object_); }

  /// Displacements of particles first … first + count − 1 since rest, m.
  Positions shifts_m(int first, int count) const;
  /// Largest downward displacement of the particles from `first` on, m; at least 0.
  double deepest_m(int first) const;
  const MpmSetup& setup() const { return setup_; }
  const std::vector<ParticlePack>& packs() const { return sorted_.packs; }
  /// Continues from another state of all particles, in any order.
  void set_packs(std::vector<ParticlePack> packs);

  /// Momentum Σ m v of the gel, kg m/s, and kinetic energy Σ ½ m v², J.
  Vector3 momentum() const;
  double kinetic_energy_j() const;

  int num_particles() const { return num_particles_; }
  std::size_t num_nodes() const { return sorted_.slab.num_nodes(); }
  int num_steps() const { return num_steps_; }
  int num_sorts() const { return num_sorts_; }
  /// Largest speed of a particle in the last step.
  double largest_speed_m_s() const { return largest_speed_ * metres_per_cell() / setup_.step_s; }

 private:
  /// Positions of the object's points in a pose, in cells of the whole grid.
  void object_points(const Matrix4& gel_from_object, std::vector<std::array<double, 3>>& points) const;
  void sort();
  /// Moves the object's points by this step, after sorting if anything has drifted too far.
  /// \return largest displacement, cells
  double move_object(const Matrix4& gel_from_object);
  double metres_per_cell() const { return setup_.grid_spacing_m; }
  template <typename Visit>
  void for_each_particle(const Visit& visit) const;

  MpmSetup setup_;
  StepMaterial material_;
  int num_particles_ = 0;
  int num_steps_ = 0;
  int num_sorts_ = 0;
  double drift_ = 0.0;          // cells that anything may have moved since the last sort
  double largest_speed_ = 0.0;  // cells per step
  SortedParticles sorted_;
  Matrix4 gel_from_object_ = Matrix4::Identity();
  Positions object_m_ = Positions(0, 3);           // object points in the object's frame
  std::vector<std::array<double, 3>> object_now_;  // cells
  std::vector<std::array<double, 3>> object_next_;
  std::vector<int> near_points_;       // object points near the gel, tile by tile
  std::vector<int> first_near_point_;  // index of each tile's first near point, and the end
  std::vector<MovingPoint> moving_;    // moving points in the order of near_points_
};

}  // namespace tacipc
