// Energy that keeps an affine body rigid: a penalty on deformations that are not rotations.
#pragma once

#include <array>

#include "stages/gel/press/energy/affine_body.h"
#include "stages/gel/press/energy/energy_term.h"

namespace tacipc {

/// Stiffness κ of bodies that count as rigid. A body then acts as a solid with Young's modulus 8κ and Poisson's ratio
/// 0: ±10 N on a cube of 20 mm strain it by 3·10⁻⁵, 0.6 µm, less than any label shows. A larger κ only adds cost: a
/// straight path leaves the rotations by half the angle squared, and the number of Newton iterations along a rotation
/// grows like κ^0.3.
inline constexpr double kOrthogonalityPa = 1e8;

/// κ with which a body of any size counts as rigid. A force F strains a body of size L by F/(8 κ L²), so a small body
/// needs a larger κ to limit its strain to 2·10⁻⁴ under ten newtons.
double orthogonality_pa(const AffineBody& body);

/// Energy Ψ = κ V ‖AᵀA − I‖², J, of one affine body, A = Σₖ pₖ gₖᵀ; κ in Pa [Lan et al. 2022].
class Orthogonality final : public EnergyTerm {
 public:
  /// The body's control points are vertices first_vertex … first_vertex + 3 of x.
  Orthogonality(int first_vertex, const AffineBody& body, double stiffness_pa = kOrthogonalityPa);

  int num_stencils() const override { return 1; }
  std::span<const int> stencil(int) const override { return vertices_; }
  /// Derivatives: ∂Ψ/∂pₖ = 4κV A C gₖ with C = AᵀA − I;
  /// ∂²Ψ/∂pₖ∂pⱼ = 4κV [(gₖ · C gⱼ) I + (A gⱼ)(A gₖ)ᵀ + (gₖ · gⱼ) A Aᵀ]. Only the first term can be indefinite.
  void evaluate(int i, const Eigen::VectorXd& x, Order order, Local& out) const override;

 private:
  std::array<int, 4> vertices_;
  Eigen::Matrix<double, 3, 4> gradients_per_m_;  // column k is gₖ
  double stiffness_j_;                           // κ V
};

}  // namespace tacipc
