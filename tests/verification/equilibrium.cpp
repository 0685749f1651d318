#include "tests/verification/equilibrium.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <span>

#include "common/base/error.h"

namespace tacipc::verify {
namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// Calls use(weight, stencil, local) for each stencil that has something to say.
template <typename Use>
void each_stencil(const std::vector<WeightedTerm>& terms, const Positions& x, Order order, Use&& use) {
  Local local;
  Eigen::VectorXd at;
  for (const WeightedTerm& weighted : terms) {
    for (int i = 0; i < weighted.term->num_stencils(); ++i) {
      const auto stencil = weighted.term->stencil(i);
      gather(x, stencil, at);
      weighted.term->evaluate(i, at, order, local);
      if (!local.zero) use(weighted.weight, stencil, local);
    }
  }
}

SparseMatrix assemble(const std::vector<WeightedTerm>& terms, const Positions& x, const std::vector<int>& number,
                      int free, Order order) {
  std::vector<Eigen::Triplet<double>> entries;
  each_stencil(terms, x, order, [&](double weight, std::span<const int> stencil, const Local& local) {
    const auto size = static_cast<Eigen::Index>(3 * stencil.size());
    for (Eigen::Index r = 0; r < size; ++r) {
      const int row = number[3 * stencil[r / 3] + r % 3];
      for (Eigen::Index c = 0; c < size && row >= 0; ++c) {
        const int column = number[3 * stencil[c / 3] + c % 3];
        if (column >= 0) entries.emplace_back(row, column, weight * local.hessian(r, c));
      }
    }
  });
  SparseMatrix matrix(free, free);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

Positions total_gradient(const std::vector<WeightedTerm>& terms, const Positions& x) {
  Positions out = Positions::Zero(x.rows(), 3);
  each_stencil(terms, x, Order::gradient, [&](double weight, std::span<const int> stencil, const Local& local) {
    for (Eigen::Index r = 0; r < static_cast<Eigen::Index>(3 * stencil.size()); ++r)
      out(stencil[r / 3], r % 3) += weight * local.gradient[r];
  });
  return out;
}

double total_value(const std::vector<WeightedTerm>& terms, const Positions& x) {
  return IncrementalPotential{terms}.value(x);
}

void find_equilibrium(const std::vector<WeightedTerm>& terms, const std::vector<bool>& fixed, double tolerance_m,
                      Positions& x, int max_iterations) {
  std::vector<int> number(fixed.size(), -1);
  int free = 0;
  for (std::size_t i = 0; i < fixed.size(); ++i)
    if (!fixed[i]) number[i] = free++;
  Eigen::SimplicialLLT<SparseMatrix> solver;
  double scale = 0.0;  // of the energies met, whose rounding a decrease may drown in
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    const Positions gradient = total_gradient(terms, x);
    Eigen::VectorXd right(free);
    for (std::size_t i = 0; i < fixed.size(); ++i)
      if (number[i] >= 0) right[number[i]] = -gradient.data()[i];
    solver.compute(assemble(terms, x, number, free, Order::hessian));
    if (solver.info() != Eigen::Success) solver.compute(assemble(terms, x, number, free, Order::psd));
    if (solver.info() != Eigen::Success) throw SolverError("the system of a patch test does not factorise");
    const Eigen::VectorXd step = solver.solve(right);
    const double before = total_value(terms, x), slope = -right.dot(step);
    scale = std::max(scale, std::abs(before));
    const bool converged = step.cwiseAbs().maxCoeff() < tolerance_m;
    for (double length = 1.0;; length *= 0.5) {
      Positions next = x;
      for (std::size_t i = 0; i < fixed.size(); ++i)
        if (number[i] >= 0) next.data()[i] += length * step[number[i]];
      // Near the minimum differences of the energy are rounding: a full step that small is taken as it is.
      const double after = converged ? before : total_value(terms, next);
      if (converged || after <= before + 1e-4 * length * slope + 1e-12 * scale) {
        x = next;
        break;
      }
      if (length < 1e-8) throw SolverError("no step lowers the energy of a patch test");
    }
    if (converged) return;
  }
  throw SolverError("a patch test did not converge within {} iterations", max_iterations);
}

}  // namespace tacipc::verify
