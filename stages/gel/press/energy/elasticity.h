// Elastic energy of the gel with linear tetrahedra: a constant deformation gradient in each.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "stages/gel/press/energy/elastic_packs.h"
#include "stages/gel/press/energy/energy_term.h"
#include "stages/gel/press/energy/tet_energy.h"

namespace tacipc {

/// Energy Φ(x) = Σ_t V_t ψ(F_t), F_t = Σᵢ xᵢ ∇Nᵢᵀ, J [Eq. 3].
class Elasticity final : public EnergyTerm {
 public:
  Elasticity(const Positions& rest, const Tetrahedra& tets, const ElasticLaw& law);
  /// Restriction of `whole` to some of its tetrahedra.
  Elasticity(const Elasticity& whole, const std::vector<int>& which);

  int num_stencils() const override { return static_cast<int>(tets_.rows()); }
  std::span<const int> stencil(int i) const override { return {&tets_(i, 0), 4}; }
  void evaluate(int i, const Eigen::VectorXd& x, Order order, Local& out) const override;

  double value(const Positions& x) const override;

  const std::vector<RestTet>& rest() const { return rest_; }
  /// Packs of the same tetrahedra if the law supports them; else null.
  const ElasticPacks* packs() const { return packs_ ? &*packs_ : nullptr; }

 private:
  Tetrahedra tets_;
  std::vector<RestTet> rest_;
  ElasticLaw law_;
  std::shared_ptr<const std::vector<int>> rank_;  // rank of each vertex along the space-filling curve
  std::optional<ElasticPacks> packs_;
};

/// Lumped masses, kg: a quarter of each tetrahedron's mass at each of its vertices.
Eigen::VectorXd lumped_masses(const Tetrahedra& tets, const std::vector<RestTet>& rest, Eigen::Index num_vertices,
                              double density_kg_m3);

/// Smallest ratio of deformed to rest volume.
double min_volume_ratio(const Positions& x, const Tetrahedra& tets, const std::vector<RestTet>& rest);

}  // namespace tacipc
