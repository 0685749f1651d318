// What every energy looks like: a list of stencils of up to four vertices and one local function.
#pragma once

#include <Eigen/Core>
#include <span>
#include <string_view>

#include "stages/press/contact/distance.h"

namespace tacipc {

/// How far to differentiate. `psd` asks for a positive semi-definite stand-in for the Hessian, which keeps Newton's
/// step a descent direction; `hessian` for the exact one.
enum class Order { value, gradient, hessian, psd };

/// Value and derivatives over the stencil's coordinates, first vertex first; entries beyond 3 × #vertices are not set.
struct Local {
  double value = 0.0;
  Vector12 gradient;
  Matrix12 hessian;
  bool zero = false;  // nothing to add: value, gradient and Hessian all vanish
};

/// Immutable sum Σᵢ eᵢ over stencils. Terms know neither time step nor weights.
class EnergyTerm {
 public:
  virtual ~EnergyTerm() = default;
  virtual std::string_view name() const = 0;
  virtual int num_stencils() const = 0;
  virtual std::span<const int> stencil(int i) const = 0;
  /// Evaluates stencil i at its vertices' coordinates `x` (first 3 × #vertices used). A value of +∞ means x is not
  /// allowed.
  virtual void evaluate(int i, const Vector12& x, Order order, Local& out) const = 0;
};

/// Nearest positive semi-definite matrix (negative eigenvalues set to zero), in place.
void project_psd(Matrix12& matrix);

}  // namespace tacipc
