// Elastic stress of every tetrahedron, over its undeformed shape.
#pragma once

#include <memory>
#include <vector>

#include "common/base/symmetric_rows.h"
#include "stages/gel/press/energy/tet_clusters.h"
#include "stages/gel/press/energy/tet_energy.h"

namespace tacipc {

/// Tetrahedra of a mesh with their rest shapes.
struct RestBody {
  Tetrahedra tets;
  std::vector<RestTet> rest;
};

/// Second Piola–Kirchhoff stress S = 2 ∂ψ/∂C = F⁻¹ P, Pa, of each tetrahedron, such that Σ_t V_t F_t S_t ∇Nᵢ is the
/// derivative of the element's energy by vertex i. A rotation of the gel leaves it as it is. With volumes averaged over
/// clusters a tetrahedron has S of ψ_μ and the pressure of its cluster,
///   S = F⁻¹ P_μ + u′ J C⁻¹,   u′ = λ ln J̄/J̄ of averaged_elasticity.h.
class TetStress {
 public:
  /// `clusters`: of averaged volumes; none for the linear element.
  TetStress(std::shared_ptr<const RestBody> body, const ElasticLaw& law, TetClusters clusters);

  /// \pre no tetrahedron is inverted
  SymmetricRows operator()(const Positions& x) const;

  const std::shared_ptr<const RestBody>& body() const { return body_; }

 private:
  std::shared_ptr<const RestBody> body_;
  ElasticLaw law_;  // with clusters: λ = 0
  TetClusters clusters_;
  double lambda_pa_ = 0.0;  // of the clusters
};

/// Cauchy stress σ = F S Fᵀ/J = P Fᵀ/J, Pa, along the axes of `x`, such that Σ_t v_t σ_t ∇ₓNᵢ is the same derivative.
/// \param second_pa S of each tetrahedron, or S with what a gel whose stress relaxes remembers \pre none is inverted
SymmetricRows cauchy_stress(const RestBody& body, const Positions& x, const SymmetricRows& second_pa);

}  // namespace tacipc
