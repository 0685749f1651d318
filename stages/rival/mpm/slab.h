// Part of the grid that particles touch: a block of nodes, and the tiles in which particles are stored.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace tacipc {

/// Cells that a particle may move along each axis before particles are sorted again.
constexpr int kDrift = 2;
/// Edge of a tile in cells, seen from above. Tiles two apart share no node as long as no drift exceeds kDrift: 2 ·
/// kTile > kTile + 2 · kDrift + 2.
constexpr int kTile = 8;
static_assert(kTile >= 2 * kDrift + 3);

/// A node holds momentum and mass while particles are scattered, then velocity. Nodes above each other are neighbours
/// in memory. Cells and nodes are counted from the slab's first one. A particle's cell is that of the first of the 3 ×
/// 3 × 3 nodes it reaches.
struct Slab {
  std::array<int, 3> origin{};  // position of the first node in the whole grid
  std::array<int, 3> nodes{};   // numbers of nodes along x, y, z; a multiple of four along z
  std::array<int, 2> tiles{};
  int held_nodes = 0;         // number of the lowest nodes of each column that do not move
  std::vector<float> values;  // 4 per node

  std::size_t num_nodes() const { return static_cast<std::size_t>(nodes[0]) * nodes[1] * nodes[2]; }
  int num_tiles() const { return tiles[0] * tiles[1]; }
};

}  // namespace tacipc
