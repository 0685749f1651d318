// What keeps an affine body rigid: the penalty of a deformation that is no rotation.
#pragma once

#include <array>

#include "stages/gel/press/energy/affine_body.h"
#include "stages/gel/press/energy/energy_term.h"

namespace tacipc {

/// κ of bodies that should count as rigid. A body then acts as a solid with Young's modulus 8κ and Poisson's ratio 0:
/// ±10 N on a cube of 20 mm strain it by 3·10⁻⁵, 0.6 µm, less than any label shows. A larger κ only costs: a straight
/// path leaves the rotations by half the angle squared, and Newton's iterations along a turn grow like κ^0.3.
inline constexpr double kOrthogonalityPa = 1e8;

/// κ of a body that should count as rigid whatever its size: F strains a body of size L by F/(8 κ L²), so that a small
/// one has to be stiffer to bear ten newtons with a strain of 2·10⁻⁴.
double orthogonality_pa(const AffineBody& body);

/// Ψ = κ V ‖AᵀA − I‖² in J, A = Σₖ pₖ gₖᵀ of one affine body; κ in Pa. [Lan et al. 2022]
class Orthogonality final : public EnergyTerm {
 public:
  /// The body's control points are vertices first_vertex … first_vertex + 3 of x.
  Orthogonality(int first_vertex, const AffineBody& body, double stiffness_pa = kOrthogonalityPa);

  int num_stencils() const override { return 1; }
  std::span<const int> stencil(int) const override { return vertices_; }
  /// ∂Ψ/∂pₖ = 4κV A C gₖ with C = AᵀA − I;
  /// ∂²Ψ/∂pₖ∂pⱼ = 4κV [(gₖ · C gⱼ) I + (A gⱼ)(A gₖ)ᵀ + (gₖ · gⱼ) A Aᵀ]. Only the first part can be indefinite.
  void evaluate(int i, const Eigen::VectorXd& x, Order order, Local& out) const override;

 private:
  std::array<int, 4> vertices_;
  Eigen::Matrix<double, 3, 4> gradients_per_m_;  // column k is gₖ
  double stiffness_j_;                           // κ V
};

}  // namespace tacipc
