// Interface of energies over contact pairs: most stencils vanish, and their Hessians are indefinite.
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

/// Set of vertices of a pair: bit k for the k-th.
using PairVertices = unsigned;
constexpr PairVertices kAllPairVertices = 0b1111;

/// An energy over contact pairs.
class ContactTerm : public EnergyTerm {
 public:
  /// Stencils that do not vanish at x, ascending, or a superset.
  virtual std::vector<int> active(const Positions& x) const = 0;

  /// Value of the term at x. \param active stencils that are active at x
  virtual double value_of(const std::vector<int>& active, const Positions& x) const = 0;
  double value(const Positions& x) const final { return value_of(active(x), x); }

  /// Gradient of stencil i. \return false if the stencil vanishes
  virtual bool evaluate_gradient(int i, const FourPoints& x, Vector12& out) const = 0;

  /// Gradient of stencil i and the Hessian (1 − blend) H + blend H₊, with H the exact one and H₊ its PSD approximation
  /// (Order::psd). Only gradients of `wanted` vertices and blocks between them are written.
  /// \return false, with nothing written, if the stencil vanishes
  virtual bool evaluate_blended(int i, const FourPoints& x, double blend, PairVertices wanted,
                                PairLocal& out) const = 0;

  /// evaluate_blended() for eight stencils of one kind, each with its own blend, over the vertices of one primitive.
  /// \param count number of stencils; the others are ignored
  virtual void evaluate_pack(const StencilPack& which, int count, const Positions& x, const Pack& blend,
                             WantedVertices wanted, PackedBlocks& out) const = 0;
};

}  // namespace tacipc
