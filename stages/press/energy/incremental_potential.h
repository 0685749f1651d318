// The sum that a time step minimises.
#pragma once

#include <memory>
#include <vector>

#include "stages/press/energy/contact_barrier.h"
#include "stages/press/energy/elasticity.h"
#include "stages/press/energy/inertia.h"

namespace tacipc {

struct WeightedTerm {
  double weight;
  std::shared_ptr<const EnergyTerm> term;
};

/// Ê(x) = inertia + h² Φ(x) + κ B(x), in kg m².   [Eq. 3, 5]
struct IncrementalPotential {
  std::vector<WeightedTerm> terms;

  /// Ê(x), +∞ where x is not allowed. The sum runs in a fixed order.
  double value(const Positions& x) const;
};

IncrementalPotential make_incremental_potential(double h_s, double kappa, std::shared_ptr<const Inertia> inertia,
                                                std::shared_ptr<const Elasticity> elasticity,
                                                std::shared_ptr<const ContactBarrier> barrier);

/// Coordinates of a stencil's vertices, 3 each.
inline void gather(const Positions& x, std::span<const int> stencil, Eigen::VectorXd& out) {
  out.resize(3 * static_cast<Eigen::Index>(stencil.size()));
  for (std::size_t k = 0; k < stencil.size(); ++k) out.segment<3>(3 * static_cast<Eigen::Index>(k)) = x.row(stencil[k]);
}

}  // namespace tacipc
