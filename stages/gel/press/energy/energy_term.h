// What every energy looks like: a list of stencils, each of a few vertices, and one local function.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>

#include "stages/gel/press/contact/distance.h"

namespace tacipc {

/// How far to differentiate. `psd` asks for a positive semi-definite approximation of the Hessian, which makes
/// Newton's step a descent direction; `hessian` for the exact one.
enum class Order { value, gradient, hessian, psd };

/// Value and derivatives over the stencil's coordinates, first vertex first. What `order` does not ask for, or what a
/// zero or infinite value makes meaningless, is left as it was.
struct Local {
  double value = 0.0;
  Eigen::VectorXd gradient;  // 3 × #vertices
  Eigen::MatrixXd hessian;   // 3 × #vertices squared
  bool zero = false;         // nothing to add: value, gradient and Hessian all vanish

  /// Makes room for what `order` asks for; storage that fits already is kept, so that a Local that is reused for
  /// stencils of one size allocates once.
  void fit(Eigen::Index num_vertices, Order order) {
    if (order >= Order::gradient) gradient.resize(3 * num_vertices);
    if (order >= Order::hessian) hessian.resize(3 * num_vertices, 3 * num_vertices);
  }
};

/// Immutable sum Σᵢ eᵢ over stencils. Terms know neither time step nor weights.
class EnergyTerm {
 public:
  virtual ~EnergyTerm() = default;
  virtual int num_stencils() const = 0;
  virtual std::span<const int> stencil(int i) const = 0;
  /// Evaluates stencil i at its vertices' coordinates `x` (3 × #vertices). A value of +∞ means x is not allowed.
  virtual void evaluate(int i, const Eigen::VectorXd& x, Order order, Local& out) const = 0;

  /// Σᵢ eᵢ(x), +∞ where x is not allowed. The sum runs in an order that does not depend on threads.
  virtual double value(const Positions& x) const;
};

/// Coordinates of a stencil's vertices, 3 each.
inline void gather(const Positions& x, std::span<const int> stencil, Eigen::VectorXd& out) {
  out.resize(3 * static_cast<Eigen::Index>(stencil.size()));
  for (std::size_t k = 0; k < stencil.size(); ++k) out.segment<3>(3 * static_cast<Eigen::Index>(k)) = x.row(stencil[k]);
}

/// Σ part(i) over i < count: partial sums over fixed chunks, added in order, so that the result does not depend on the
/// threads.
double ordered_sum(int count, const std::function<double(int first, int last)>& part);

/// Nearest positive semi-definite matrix (negative eigenvalues set to zero), in place.
void project_psd(Matrix12& matrix);

}  // namespace tacipc
