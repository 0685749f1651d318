// Neo-Hookean tetrahedra in packs of eight.
#pragma once

#include <array>
#include <vector>

#include "common/base/simd.h"
#include "stages/gel/press/energy/tet_energy.h"

namespace tacipc {

/// The energy of tet_energy() with NeoHookean for all tetrahedra of a gel, in packs of eight neighbours. Tetrahedron
/// `order[i]` is in lane i % 8 of pack i / 8.
class ElasticPacks {
 public:
  /// \param order order in which the tetrahedra are packed: neighbours should follow one another
  /// \param rank rank of each vertex: the corners of each tetrahedron are sorted by it, so that their blocks lie in the
  /// same triangle of a matrix with the same numbering
  ElasticPacks(const Tetrahedra& tets, const std::vector<RestTet>& rest, const NeoHookean& law,
               const std::vector<int>& order, const std::vector<int>& rank);

  /// Corners of the tetrahedra of one pack; the last pack repeats its last tetrahedron, with zero volume.
  struct Corners {
    std::array<std::array<int, kLanes>, 4> vertices;  // index: corner, lane
    int count;                                        // number of lanes with a tetrahedron
  };
  int size() const { return static_cast<int>(packs_.size()); }
  const Corners& corners(int pack) const { return packs_[static_cast<std::size_t>(pack)].corners; }

  /// Energy Σ V ψ(F), J, over all tetrahedra; +∞ if one is inverted.
  double value(const Positions& x) const;
  /// Deformed volumes v = V J, m³, of the kLanes tetrahedra of one pack.
  void volumes(int pack, const Positions& x, double* out) const;

  /// Blocks (a, b), a ≥ b, in the order 00 10 20 30 11 21 31 22 32 33, each column by column.
  static constexpr int kBlocks = 10;
  struct Derivatives {
    Pack gradient[4][3];
    Pack hessian[kBlocks][9];
  };
  /// State on which the Hessian of one pack depends: F by rows, and p J.
  struct State {
    Pack3 row[3];
    Pack pressure_J;
  };
  /// Exact gradient and Hessian of V [ψ(F) + p J] of one pack, and the state at x.
  /// \param pressure p of each of the kLanes tetrahedra, Pa; null: zero
  /// \pre no tetrahedron is inverted
  void derivatives(int pack, const Positions& x, const double* pressure, State& state, Derivatives& out) const;
  /// Updates the Hessian of a pack only if it has changed. `out.gradient` is as in derivatives().
  /// \param tolerance change of a tetrahedron's Hessian since the state `known` (ΔF F⁻¹, or p J in shear moduli) above
  /// which the pack has changed
  /// \return true if the pack has changed: `out.hessian` is its Hessian minus that of `known`, and `known` is the state
  /// at x. False: both are unchanged
  bool change(int pack, const Positions& x, const double* pressure, double tolerance, State& known,
              Derivatives& out) const;

 private:
  struct Rest {
    Corners corners;
    Pack3 shape_gradients[3];  // gradients of corners 1 … 3; all four sum to zero
    Pack volume_m3;
  };
  std::vector<Rest> packs_;
  NeoHookean law_;
};

}  // namespace tacipc
