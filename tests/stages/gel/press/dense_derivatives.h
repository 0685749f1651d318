// Gradient and Hessian of an energy over all vertices, stencil by stencil into dense matrices: what sparse assembly and
// its solvers are compared with.
#pragma once

#include "stages/gel/press/energy/energy_term.h"

namespace tacipc {

struct DenseDerivatives {
  Eigen::VectorXd gradient;
  Eigen::MatrixXd hessian;
};

inline DenseDerivatives operator*(double weight, DenseDerivatives d) {
  d.gradient *= weight;
  d.hessian *= weight;
  return d;
}
inline DenseDerivatives& operator+=(DenseDerivatives& sum, const DenseDerivatives& d) {
  sum.gradient += d.gradient;
  sum.hessian += d.hessian;
  return sum;
}

/// `order` is hessian or psd.
inline DenseDerivatives dense_derivatives(const EnergyTerm& term, const Positions& x, Order order) {
  const Eigen::Index n = 3 * x.rows();
  DenseDerivatives sum{Eigen::VectorXd::Zero(n), Eigen::MatrixXd::Zero(n, n)};
  Local local;
  Eigen::VectorXd local_x;
  for (int i = 0; i < term.num_stencils(); ++i) {
    const std::span<const int> stencil = term.stencil(i);
    gather(x, stencil, local_x);
    local.zero = false;
    term.evaluate(i, local_x, order, local);
    if (local.zero) continue;
    for (std::size_t a = 0; a < stencil.size(); ++a) {
      const auto local_a = 3 * static_cast<Eigen::Index>(a);
      sum.gradient.segment<3>(3 * stencil[a]) += local.gradient.segment<3>(local_a);
      for (std::size_t b = 0; b < stencil.size(); ++b)
        sum.hessian.block<3, 3>(3 * stencil[a], 3 * stencil[b]) +=
            local.hessian.block<3, 3>(local_a, 3 * static_cast<Eigen::Index>(b));
    }
  }
  return sum;
}

}  // namespace tacipc
