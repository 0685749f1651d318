// Elastic stress of every tetrahedron, over its undeformed shape.
#pragma once

#include <memory>
#include <vector>

#include "stages/gel/press/energy/tet_clusters.h"
#include "stages/gel/press/energy/tet_energy.h"

namespace tacipc {

/// Symmetric 3 × 3 tensors, one per tetrahedron: a row xx yy zz yz xz xy each.
using SymmetricRows = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;

inline Matrix3 symmetric(const SymmetricRows& rows, Eigen::Index t) {
  const auto r = rows.row(t);
  return Matrix3{{r[0], r[5], r[4]}, {r[5], r[1], r[3]}, {r[4], r[3], r[2]}};
}

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

}  // namespace tacipc
