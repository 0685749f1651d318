// Energy of a viscoelastic gel's memory during one time step.
#pragma once

#include <memory>
#include <vector>

#include "stages/gel/press/energy/energy_term.h"
#include "stages/gel/press/energy/tet_stress.h"

namespace tacipc {

/// Energy Σ_t V_t M_t : E_t, J, with E = ½ (FᵀF − I) Green's strain and M a symmetric stress (Pa) that is constant
/// during the step (viscoelasticity.h). It is quadratic in the positions: with the shape gradients ∇Nᵢ the derivatives
/// of one tetrahedron are
///   ∂/∂xᵢ = V F M ∇Nᵢ,   ∂²/∂xᵢ∂xⱼ = V (∇Nᵢ · M ∇Nⱼ) I.
/// The Hessian is constant, and indefinite if M is compressive in some direction. Its nearest positive semi-definite
/// approximation (over F, Order::psd) is that of M without its negative eigenvalues.
class ViscousMemory final : public EnergyTerm {
 public:
  /// \pre one row of stress per tetrahedron
  ViscousMemory(std::shared_ptr<const RestBody> body, SymmetricRows stress_pa);
  /// Restriction of `whole` to some of its tetrahedra.
  ViscousMemory(const ViscousMemory& whole, const std::vector<int>& which);

  int num_stencils() const override { return static_cast<int>(which_.size()); }
  std::span<const int> stencil(int i) const override { return {&body_->tets(which_[i], 0), 4}; }
  void evaluate(int i, const Eigen::VectorXd& x, Order order, Local& out) const override;

  double value(const Positions& x) const override;
  /// Gradient of one stencil, one column per vertex, J/m.
  TetCorners gradient(int i, const Positions& x) const;

 private:
  const RestTet& rest(int i) const {
    return body_->rest[static_cast<std::size_t>(which_[static_cast<std::size_t>(i)])];
  }
  Matrix3 stress(int i) const { return symmetric(*stress_pa_, which_[static_cast<std::size_t>(i)]); }
  TetCorners corners(int i, const Positions& x) const;

  std::shared_ptr<const RestBody> body_;
  std::shared_ptr<const SymmetricRows> stress_pa_;  // stress of all tetrahedra
  std::vector<int> which_;                          // indices of the tetrahedra
};

}  // namespace tacipc
