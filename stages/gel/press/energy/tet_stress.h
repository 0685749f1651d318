// Elastic stress of every tetrahedron relative to its undeformed shape.
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
/// derivative of the element's energy by vertex i. It is invariant under rotation of the gel. If volumes are averaged
/// over clusters, a tetrahedron has S of ψ_μ and the pressure of its cluster,
///   S = F⁻¹ P_μ + u′ J C⁻¹,   u′ = λ ln J̄/J̄ of averaged_elasticity.h.
class TetStress {
 public:
  /// \param clusters clusters of averaged volumes; empty for the linear element
  TetStress(std::shared_ptr<const RestBody> body, const ElasticLaw& law, TetClusters clusters);

  /// Stress of each tetrahedron at x. \pre no tetrahedron is inverted
  SymmetricRows operator()(const Positions& x) const;

  const std::shared_ptr<const RestBody>& body() const { return body_; }

 private:
  std::shared_ptr<const RestBody> body_;
  ElasticLaw law_;  // λ = 0 if there are clusters
  TetClusters clusters_;
  double lambda_pa_ = 0.0;  // λ of the clusters
};

/// Cauchy stress σ = F S Fᵀ/J = P Fᵀ/J, Pa, along the axes of `x`, such that Σ_t v_t σ_t ∇ₓNᵢ is the derivative of the
/// energy by vertex i.
/// \param second_pa S of each tetrahedron, for a viscoelastic gel including its memory
/// \pre no tetrahedron is inverted
SymmetricRows cauchy_stress(const RestBody& body, const Positions& x, const SymmetricRows& second_pa);

}  // namespace tacipc
