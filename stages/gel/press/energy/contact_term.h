// Energies over contact pairs: most stencils vanish, and their Hessians are indefinite.
#pragma once

#include <vector>

#include "stages/gel/press/energy/contact_packs.h"
#include "stages/gel/press/energy/energy_term.h"

namespace tacipc {

/// Derivatives over the four vertices of a pair, first vertex first.
struct PairLocal {
  Vector12 gradient;
  Matrix12 hessian;
};

/// Vertices of a pair, bit k for the k-th.
using PairVertices = unsigned;
constexpr PairVertices kAllPairVertices = 0b1111;

class ContactTerm : public EnergyTerm {
 public:
  /// Stencils that do not vanish at x, ascending, and perhaps some that do.
  virtual std::vector<int> active(const Positions& x) const = 0;

  /// Σ over the stencils that are active at x: the term's value there.
  virtual double value_of(const std::vector<int>& active, const Positions& x) const = 0;
  double value(const Positions& x) const final { return value_of(active(x), x); }

  /// Gradient of stencil i; false where it vanishes.
  virtual bool evaluate_gradient(int i, const FourPoints& x, Vector12& out) const = 0;

  /// Gradient and the Hessian (1 − blend) H + blend H₊ with H the exact one and H₊ its PSD approximation (Order::psd),
  /// of stencil i; only blocks between `wanted` vertices are written, and gradients of those. False, and nothing
  /// written, where the stencil vanishes.
  virtual bool evaluate_blended(int i, const FourPoints& x, double blend, PairVertices wanted,
                                PairLocal& out) const = 0;

  /// The same for eight stencils of one kind, each with its blend, for vertices of one primitive; the first `count`
  /// stencils count.
  virtual void evaluate_pack(const StencilPack& which, int count, const Positions& x, const Pack& blend,
                             WantedVertices wanted, PackedBlocks& out) const = 0;
};

}  // namespace tacipc
