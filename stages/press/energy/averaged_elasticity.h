// Elastic energy of a locking-free element: linear tetrahedra that share their change of volume within a patch.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "stages/press/energy/elastic_packs.h"
#include "stages/press/energy/energy_term.h"
#include "stages/press/energy/tet_energy.h"
#include "stages/press/energy/tet_patches.h"

namespace tacipc {

/// Φ(x) = Σ_t V_t ψ_μ(F_t) + Σ_P V_P λ/2 (ln J̄_P)², in J; J̄_P = Σ_{t∈P} v_t / V_P is the patch's deformed over its rest
/// volume, and ψ_μ(F) = ψ(F) − λ/2 (ln J)².   [de Souza Neto et al. 2005 (F-bar patch), here with the volumetric energy
/// of the patch, so that there is an energy to minimise]
/// A linear tetrahedron of a nearly incompressible solid has one volume to keep and, in a mesh, half a vertex to keep
/// it with: it locks. A patch has one volume for all. ψ_μ stays with each tetrahedron, resists its inversion and, by
/// its own part in the bulk modulus (2μ/3), its change of volume inside the patch. With u(v) = V_P λ/2 ln²(v/V_P), v
/// the patch's volume:
///   ∂Φ = Σ V_t ∂ψ_μ + u′ ∂v,   ∂²Φ = Σ [V_t ∂²ψ_μ + u′ ∂²v_t] + u″ ∂v ∂vᵀ,   u′ = λ ln J̄/J̄,   u″ = λ(1 − ln J̄)/(V J̄²).
/// The stand-in (Order::psd) projects each bracket over one tetrahedron in closed form and keeps u″ ≥ 0.
class AveragedElasticity final : public EnergyTerm {
 public:
  /// \throw DataError naming the first tetrahedron that is not positively oriented.
  AveragedElasticity(const Positions& rest, const Tetrahedra& tets, const ElasticLaw& law, const TetPatches& patches);
  /// Some patches of another.
  AveragedElasticity(const AveragedElasticity& whole, const std::vector<int>& which);

  std::string_view name() const override { return "averaged_elasticity"; }
  int num_stencils() const override { return static_cast<int>(patches_.size()); }
  std::span<const int> stencil(int i) const override { return patches_[i].vertices; }
  void evaluate(int i, const Eigen::VectorXd& x, Order order, Local& out) const override;

  double value(const Positions& x) const override;

  /// ψ_μ of the same tetrahedra in packs, patch by patch, for a law that has them; else null. Under the pressures of
  /// VolumeDerivatives, their derivatives are all of ∂Φ and all but the last part of ∂²Φ.
  const ElasticPacks* packs() const { return packs_ ? &*packs_ : nullptr; }
  struct VolumeDerivatives {
    std::vector<double> pressure;  // u′ of its patch for each tetrahedron of each pack, kLanes a pack, Pa
    std::vector<double> second;    // u″ of each patch, J/m⁶
  };
  /// \pre there are packs, no patch is inside out
  VolumeDerivatives volume_derivatives(const Positions& x) const;
  /// ∂v of patch i, a column per vertex of its stencil, m².
  void volume_gradient(int i, const Positions& x, Eigen::Matrix3Xd& out) const;

 private:
  struct Member {
    RestTet rest;
    std::array<int, 4> corners;  // places in the patch's vertices
  };
  struct Patch {
    std::vector<int> vertices;  // ascending
    std::vector<Member> members;
    double volume_m3;
  };

  void make_packs();
  std::vector<double> patch_volumes(const Positions& x) const;

  std::vector<Patch> patches_;
  ElasticLaw shear_law_;  // λ = 0
  double lambda_pa_ = 0.0;
  std::shared_ptr<const std::vector<int>> rank_;  // of each vertex along the space-filling curve
  std::optional<ElasticPacks> packs_;
  std::vector<int> first_place_;  // in the packs, of each patch's tetrahedra, and one past the last
};

}  // namespace tacipc
