// Neo-Hookean tetrahedra eight at a time.
#pragma once

#include <array>
#include <vector>

#include "common/base/simd.h"
#include "stages/gel/press/energy/tet_energy.h"

namespace tacipc {

/// The same energy as tet_energy over NeoHookean, for all tetrahedra of a gel in packs of eight that lie together.
/// Tetrahedron `order[i]` is in lane i % 8 of pack i / 8.
class ElasticPacks {
 public:
  /// \param order in which the tetrahedra are packed: those near each other belong together
  /// \param rank of each vertex: by it the corners of each tetrahedron are sorted, so that their blocks come to lie in
  /// the same triangle of a matrix whose unknowns are numbered alike
  ElasticPacks(const Tetrahedra& tets, const std::vector<RestTet>& rest, const NeoHookean& law,
               const std::vector<int>& order, const std::vector<int>& rank);

  /// Corners of the tetrahedra of one pack; the last pack repeats its last tetrahedron, with no volume.
  struct Corners {
    std::array<std::array<int, kLanes>, 4> vertices;  // corner, lane
    int count;                                        // lanes that are tetrahedra
  };
  int size() const { return static_cast<int>(packs_.size()); }
  const Corners& corners(int pack) const { return packs_[static_cast<std::size_t>(pack)].corners; }

  /// Σ V ψ(F) in J over all tetrahedra, +∞ where one is inverted.
  double value(const Positions& x) const;
  /// Deformed volumes v = V J in m³ of the tetrahedra of one pack, kLanes of them.
  void volumes(int pack, const Positions& x, double* out) const;

  /// Blocks (a, b) with a ≥ b in the order 00 10 20 30 11 21 31 22 32 33, each column by column.
  static constexpr int kBlocks = 10;
  struct Derivatives {
    Pack gradient[4][3];
    Pack hessian[kBlocks][9];
  };
  /// What the Hessian of one pack depends on: F by rows, and p J.
  struct State {
    Pack3 row[3];
    Pack pressure_J;
  };
  /// Exact gradient and Hessian of V [ψ(F) + p J] of one pack, and the state at x; `pressure`: p for each of kLanes
  /// tetrahedra, Pa, null for none. \pre no tetrahedron is inverted
  void derivatives(int pack, const Positions& x, const double* pressure, State& state, Derivatives& out) const;
  /// Gradient as above. Where a tetrahedron's Hessian differs from that of `known` by more than about `tolerance` (ΔF
  /// F⁻¹, or p J in shear moduli), the pack's Hessian minus that of `known`, which becomes the state at x: true. Else
  /// `out.hessian` is left as it was: false.
  bool change(int pack, const Positions& x, const double* pressure, double tolerance, State& known,
              Derivatives& out) const;

 private:
  struct Rest {
    Corners corners;
    Pack3 shape_gradients[3];  // of corners 1 … 3; all four sum to zero
    Pack volume_m3;
  };
  std::vector<Rest> packs_;
  NeoHookean law_;
};

}  // namespace tacipc
