// Interface of all energies: a list of stencils, each of a few vertices, and one local function.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>

#include "stages/gel/press/contact/distance.h"

namespace tacipc {

/// Order of differentiation. `hessian` is the exact Hessian; `psd` is a positive semi-definite approximation, with
/// which the Newton step is a descent direction.
enum class Order { value, gradient, hessian, psd };

/// Value and derivatives over the stencil's coordinates, first vertex first. Members that `order` does not ask for, or
/// that a zero or infinite value makes meaningless, keep their old values.
struct Local {
  double value = 0.0;
  Eigen::VectorXd gradient;  // 3 × #vertices
  Eigen::MatrixXd hessian;   // 3 × #vertices squared
  bool zero = false;         // nothing to add: value, gradient and Hessian vanish

  /// Resizes the members that `order` asks for. Storage that fits is kept, so a Local that is reused for stencils of
  /// one size allocates once.
  void fit(Eigen::Index num_vertices, Order order) {
    if (order >= Order::gradient) gradient.resize(3 * num_vertices);
    if (order >= Order::hessian) hessian.resize(3 * num_vertices, 3 * num_vertices);
  }
};

/// Immutable sum Σᵢ eᵢ over stencils, independent of time step and weights.
class EnergyTerm {
 public:
  virtual ~EnergyTerm() = default;
  /// Number of stencils.
  virtual int num_stencils() const = 0;
  /// Vertices of stencil i, as rows of the positions.
  virtual std::span<const int> stencil(int i) const = 0;
  /// Evaluates stencil i at its vertices' coordinates `x` (3 × #vertices). A value of +∞ means that x is not allowed.
  virtual void evaluate(int i, const Eigen::VectorXd& x, Order order, Local& out) const = 0;

  /// Value Σᵢ eᵢ(x); +∞ if x is not allowed. The order of summation does not depend on threads.
  virtual double value(const Positions& x) const;
};

/// Copies the coordinates of a stencil's vertices, three each.
inline void gather(const Positions& x, std::span<const int> stencil, Eigen::VectorXd& out) {
  out.resize(3 * static_cast<Eigen::Index>(stencil.size()));
  for (std::size_t k = 0; k < stencil.size(); ++k) out.segment<3>(3 * static_cast<Eigen::Index>(k)) = x.row(stencil[k]);
}

/// Σ part(i) over i < count: partial sums over fixed chunks, added in order, so that the result does not depend on
/// threads.
double ordered_sum(int count, const std::function<double(int first, int last)>& part);

/// Replaces a matrix by the nearest positive semi-definite one: negative eigenvalues become zero.
void project_psd(Matrix12& matrix);

}  // namespace tacipc
