// Elastic energy of a locking-free element: linear tetrahedra that share their change of volume within a cluster.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "stages/gel/press/energy/elastic_packs.h"
#include "stages/gel/press/energy/energy_term.h"
#include "stages/gel/press/energy/tet_clusters.h"
#include "stages/gel/press/energy/tet_energy.h"

namespace tacipc {

/// Energy Φ(x) = Σ_t V_t ψ_μ(F_t) + Σ_C V_C λ/2 (ln J̄_C)², J. J̄_C = Σ_{t∈C} v_t / V_C is the ratio of the cluster's
/// deformed to its rest volume, and ψ_μ(F) = ψ(F) − λ/2 (ln J)² [de Souza Neto et al. 2005 (F-bar patch), here with the
/// volumetric energy of the cluster, so that there is an energy to minimise].
///
/// A linear tetrahedron of a nearly incompressible solid has one volume to keep but, in a mesh, only about half a
/// vertex to do so: it locks. A cluster has one volume for all its tetrahedra. ψ_μ remains with each tetrahedron: it
/// resists inversion and, by its own contribution to the bulk modulus (2μ/3), changes of volume inside the cluster.
///
/// With u(v) = V_C λ/2 ln²(v/V_C), v the cluster's volume:
///   ∂Φ = Σ V_t ∂ψ_μ + u′ ∂v,   ∂²Φ = Σ [V_t ∂²ψ_μ + u′ ∂²v_t] + u″ ∂v ∂vᵀ,
///   u′ = λ ln J̄/J̄,   u″ = λ(1 − ln J̄)/(V J̄²).
/// The PSD approximation (Order::psd) projects each bracket over one tetrahedron in closed form and keeps u″ ≥ 0.
class AveragedElasticity final : public EnergyTerm {
 public:
  /// \throw DataError that names the first tetrahedron that is not positively oriented
  AveragedElasticity(const Positions& rest, const Tetrahedra& tets, const ElasticLaw& law, const TetClusters& clusters);
  /// Restriction of `whole` to some of its clusters.
  AveragedElasticity(const AveragedElasticity& whole, const std::vector<int>& which);

  int num_stencils() const override { return static_cast<int>(clusters_.size()); }
  std::span<const int> stencil(int i) const override { return clusters_[i].vertices; }
  void evaluate(int i, const Eigen::VectorXd& x, Order order, Local& out) const override;

  double value(const Positions& x) const override;

  /// Packs of ψ_μ of the same tetrahedra, cluster by cluster, if the law supports them; else null. Under the pressures
  /// of VolumeDerivatives, their derivatives are all of ∂Φ, and ∂²Φ without its last term.
  const ElasticPacks* packs() const { return packs_ ? &*packs_ : nullptr; }
  /// First and last pack with tetrahedra of cluster i. \pre there are packs
  std::pair<int, int> packs_of(int i) const {
    return {first_place_[static_cast<std::size_t>(i)] / kLanes,
            (first_place_[static_cast<std::size_t>(i) + 1] - 1) / kLanes};
  }
  struct VolumeDerivatives {
    std::vector<double> pressure;  // u′ of the cluster of each tetrahedron, kLanes per pack, Pa
    std::vector<double> second;    // u″ of each cluster, J/m⁶
  };
  /// Derivatives u′ and u″ of all clusters. \pre there are packs, and no cluster is inverted
  VolumeDerivatives volume_derivatives(const Positions& x) const;
  /// Gradient ∂v of the volume of cluster i, one column per vertex of its stencil, m².
  void volume_gradient(int i, const Positions& x, Eigen::Matrix3Xd& out) const;

 private:
  struct Member {
    RestTet rest;
    std::array<int, 4> corners;  // indices into the cluster's vertices
  };
  struct Cluster {
    std::vector<int> vertices;  // ascending
    std::vector<Member> members;
    double volume_m3;
  };

  void make_packs();
  std::vector<double> cluster_volumes(const Positions& x) const;

  std::vector<Cluster> clusters_;
  ElasticLaw shear_law_;  // λ = 0
  double lambda_pa_ = 0.0;
  std::shared_ptr<const std::vector<int>> rank_;  // rank of each vertex along the space-filling curve
  std::optional<ElasticPacks> packs_;
  std::vector<int> first_place_;  // first index in the packs of each cluster's tetrahedra, then the total number
};

}  // namespace tacipc
