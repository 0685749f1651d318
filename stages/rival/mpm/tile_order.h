// Sorts particles into tiles, in an order that depends only on their positions.
#pragma once

#include <vector>

#include "stages/rival/mpm/particle_pack.h"
#include "stages/rival/mpm/slab.h"

namespace tacipc {

/// The packs of one tile: packs[first] … packs[first + count − 1].
struct TilePacks {
  int first = 0;
  int count = 0;
};

/// Particles in the order of tiles, and their slab.
struct SortedParticles {
  Slab slab;  // large enough for a drift of kDrift cells, and for points of the object that reach the gel
  std::vector<ParticlePack> packs;  // packs tile by tile, in each tile along z, x, y of their cells
  std::vector<TilePacks> tiles;
};

/// Sorts particles by tile and cell; particles of one cell keep their order.
/// \param held_below height in cells of the whole grid at or below which nodes do not move; −∞: all nodes move
SortedParticles sort_particles(const std::vector<ParticlePack>& packs, double held_below);

/// Tile of a point of the object (in cells of the whole grid), or −1 if it touches no node that a particle can touch
/// before the next sort.
int tile_of_point(const Slab& slab, const std::array<double, 3>& point);

}  // namespace tacipc
