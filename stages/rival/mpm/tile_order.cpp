#include "stages/rival/mpm/tile_order.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tacipc {
namespace {

using Cell = std::array<int, 3>;

/// Distance beyond the particles' cells within which object points matter: they share nodes within two cells, and both
/// may drift.
constexpr int kReachCells = 2 + 2 * kDrift;

struct Slot {
  int pack = 0;
  int lane = 0;
  Cell cell{};
};

/// Every particle with its cell, in storage order.
std::vector<Slot> slots_of(const std::vector<ParticlePack>& packs) {
  std::vector<Slot> slots;
  slots.reserve(packs.size() * kParticleLanes);
  for (std::size_t p = 0; p < packs.size(); ++p) {
    for (int l = 0; l < kParticleLanes && packs[p].id[l] >= 0; ++l) {
      Slot slot{static_cast<int>(p), l, {}};
      for (std::size_t axis = 0; axis < 3; ++axis)
        slot.cell[axis] = static_cast<int>(std::floor(packs[p].rest[axis][l] + packs[p].shift[axis][l] - 0.5f));
      slots.push_back(slot);
    }
  }
  return slots;
}

/// Slab around the particles' cells low … high.
Slab slab_around(const Cell& low, const Cell& high, double held_below) {
  Slab slab;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // No points come from below, because the object is above the gel.
    const int margin_below = kDrift + (axis == 2 ? 0 : kReachCells), margin_above = kDrift + kReachCells;
    slab.origin[axis] = low[axis] - margin_below;
    const int cells = high[axis] - low[axis] + 1 + margin_below + margin_above;
    // Along z there is one more node, because columns of three nodes are updated as four.
    slab.nodes[axis] = axis == 2 ? (cells + 3 + 3) / 4 * 4 : (cells + kTile - 1) / kTile * kTile + 2;
    if (axis < 2) slab.tiles[axis] = (slab.nodes[axis] - 2) / kTile;
  }
  if (std::isfinite(held_below))
    slab.held_nodes =
        std::clamp(static_cast<int>(std::floor(held_below + 1e-6)) - slab.origin[2] + 1, 0, slab.nodes[2]);
  slab.values.resize(4 * slab.num_nodes());
  return slab;
}

void copy_particle(const ParticlePack& from, int from_lane, ParticlePack& to, int to_lane) {
  for (int k = 0; k < 3; ++k) {
    to.rest[k][to_lane] = from.rest[k][from_lane];
    to.shift[k][to_lane] = from.shift[k][from_lane];
    to.velocity[k][to_lane] = from.velocity[k][from_lane];
  }
  for (int k = 0; k < 9; ++k) {
    to.affine[k][to_lane] = from.affine[k][from_lane];
    to.deformation[k][to_lane] = from.deformation[k][from_lane];
  }
  to.id[to_lane] = from.id[from_lane];
}

/// An empty pack: undeformed, so that arithmetic on it stays finite.
ParticlePack empty_pack() {
  ParticlePack pack{};
  for (int k = 0; k < 9; k += 4) pack.deformation[k] = all_lanes(1.0f);
  for (int l = 0; l < kParticleLanes; ++l) pack.id[l] = -1;
  return pack;
}

}  // namespace

SortedParticles sort_particles(const std::vector<ParticlePack>& packs, double held_below) {
  const std::vector<Slot> slots = slots_of(packs);
  Cell low, high;
  low.fill(std::numeric_limits<int>::max());
  high.fill(std::numeric_limits<int>::min());
  for (const Slot& slot : slots) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], slot.cell[axis]);
      high[axis] = std::max(high[axis], slot.cell[axis]);
    }
  }
  SortedParticles out{.slab = slab_around(low, high, held_below), .packs = {}, .tiles = {}};
  const Slab& slab = out.slab;

  // Counting sort over the cells of all tiles, a tile's cells next to each other.
  const auto cells_of_tile = static_cast<std::size_t>(kTile * kTile * slab.nodes[2]);
  const auto key_of = [&](const Slot& slot) {
    const int x = slot.cell[0] - slab.origin[0], y = slot.cell[1] - slab.origin[1], z = slot.cell[2] - slab.origin[2];
    const int tile = x / kTile * slab.tiles[1] + y / kTile;
    return static_cast<std::size_t>(tile) * cells_of_tile +
           static_cast<std::size_t>((z * kTile + x % kTile) * kTile + y % kTile);
  };
  const auto num_tiles = static_cast<std::size_t>(slab.num_tiles());
  std::vector<int> place(num_tiles * cells_of_tile, 0);
  for (const Slot& slot : slots) ++place[key_of(slot)];
  int next = 0;
  for (std::size_t tile = 0; tile < num_tiles; ++tile) {
    const int first = next;
    for (std::size_t cell = tile * cells_of_tile; cell < (tile + 1) * cells_of_tile; ++cell)
      next += std::exchange(place[cell], next);
    next = (next + kParticleLanes - 1) / kParticleLanes * kParticleLanes;
    out.tiles.push_back({first / kParticleLanes, (next - first) / kParticleLanes});
  }
  std::vector<int> source(next, -1);
  for (std::size_t s = 0; s < slots.size(); ++s) source[place[key_of(slots[s])]++] = static_cast<int>(s);

  out.packs.resize(next / kParticleLanes);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, out.packs.size()), [&](const auto& range) {
    for (std::size_t p = range.begin(); p < range.end(); ++p) {
      ParticlePack pack = empty_pack();
      for (int l = 0; l < kParticleLanes; ++l) {
        const int from = source[p * kParticleLanes + static_cast<std::size_t>(l)];
        if (from < 0) break;
        const Slot& slot = slots[from];
        copy_particle(packs[slot.pack], slot.lane, pack, l);
      }
      out.packs[p] = pack;
    }
  });
  return out;
}

int tile_of_point(const Slab& slab, const std::array<double, 3>& point) {
  Cell cell;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double local = std::floor(point[axis] - 0.5) - slab.origin[axis];
    const double cells = axis == 2 ? slab.nodes[2] - 3 : slab.nodes[axis] - 2;
    if (!(local >= kDrift && local < cells - kDrift)) return -1;
    cell[axis] = static_cast<int>(local);
  }
  return cell[0] / kTile * slab.tiles[1] + cell[1] / kTile;
}

}  // namespace tacipc
