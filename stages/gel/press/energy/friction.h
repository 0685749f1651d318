// Smoothed Coulomb friction with lagged normal forces and tangent planes.
#pragma once

#include <memory>
#include <vector>

#include "stages/gel/press/energy/contact_barrier.h"

namespace tacipc {

/// f₁(y) = 2 y/ε − (y/ε)² for 0 ≤ y < ε, else 1: ratio of friction to its largest value after the two sides have slid
/// by y [Eq. 7]. C¹, so that Newton's method sees the transition from sticking to slipping.
double friction_part(double y, double epsilon);
/// f₀(y) = ∫ f₁ with f₀(ε) = ε: y² /ε − y³/(3 ε²) + ε/3 below ε, else y [Eq. 8].
double friction_integral(double y, double epsilon);

/// Energy D(x) = Σ_k λ_k f₀(‖u_k‖), u_k = T_kᵀ Σ wᵢ (xᵢ − xᵢᵗ), m⁴ [Eq. 6–9], over the pairs of a barrier at a lagged
/// position. Normal force λ_k = 2 d c m |b′(d²)|, weights w and tangent plane T are fixed there; κ λ_k is the barrier's
/// force between the two sides. xᵗ is the start of the time step. Multiplied by μκ, −∂D/∂x is Coulomb friction, with μ
/// the largest coefficient of all pairs of bodies; λ_k includes μ_k/μ, where μ_k is that of the pair's law.
class Friction final : public ContactTerm {
 public:
  /// \param active the barrier's active pairs at the lagged position
  /// \param epsilon_m ε_v h: slide in one step at the speed at which friction is fully developed
  Friction(const ContactBarrier& barrier, const std::vector<int>& active, const Positions& lagged,
           const Positions& start, double epsilon_m);
  Friction(const ContactBarrier& barrier, const Positions& lagged, const Positions& start, double epsilon_m)
      : Friction(barrier, barrier.active(lagged), lagged, start, epsilon_m) {}

  /// Mixture with newer friction of the same time step: the pairs of both, with normal forces times 1 − part and
  /// `part`. Pairs whose share falls below a thousandth are dropped.
  std::shared_ptr<const Friction> mixed_with(const Friction& newer, double part) const;

  /// Restriction to the pairs with any vertex that moves. \param moves one flag per vertex
  std::shared_ptr<const Friction> restricted_to(const std::vector<bool>& moves) const;

  int num_stencils() const override { return static_cast<int>(pairs_.size()); }
  std::span<const int> stencil(int i) const override { return pairs_[i].vertices; }
  void evaluate(int i, const Eigen::VectorXd& x, Order order, Local& out) const override;

  std::vector<int> active(const Positions& x) const override;  // all
  double value_of(const std::vector<int>& active, const Positions& x) const override;
  bool evaluate_gradient(int i, const FourPoints& x, Vector12& out) const override;
  bool evaluate_blended(int i, const FourPoints& x, double blend, PairVertices wanted, PairLocal& out) const override;
  void evaluate_pack(const StencilPack& which, int count, const Positions& x, const Pack& blend, WantedVertices wanted,
                     PackedBlocks& out) const override;

  /// Slide ‖u‖ / ε of pair i: below 1 it sticks.
  double relative_slide(int i, const Positions& x) const;
  /// λ_k, m³, including the ratio of the pair's coefficient of friction to that of the step.
  double normal_force(int i) const { return pairs_[i].normal_force; }
  const Eigen::Vector4d& weights(int i) const { return pairs_[i].weights; }

 private:
  struct Pair {
    std::array<int, 4> vertices;
    Eigen::Vector4d weights;
    Eigen::Matrix<double, 3, 2> tangents;  // orthonormal columns T
    Vector3 start;                         // Σ wᵢ xᵢᵗ
    double normal_force;
    double share = 1.0;  // fraction of the barrier's normal force
  };
  /// Slide Σ wᵢ (xᵢ − xᵢᵗ) in the tangent plane.
  static Eigen::Vector2d slide(const Pair& pair, const FourPoints& x);
  /// Force on the first side for a slide by u.
  Vector3 force(const Pair& pair, const Eigen::Vector2d& u) const;
  /// Inner Hessian ∂²/∂u²: the majorant f₁/y I minus (1 − blend) times its excess over the exact Hessian.
  Eigen::Matrix2d blended_inner(const Pair& pair, const Eigen::Vector2d& u, double blend) const;

  std::vector<Pair> pairs_;
  double epsilon_m_;
};

}  // namespace tacipc
