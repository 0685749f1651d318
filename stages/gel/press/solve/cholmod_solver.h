// Sparse Cholesky factorisation of a BlockMatrix: CHOLMOD with METIS ordering.
#pragma once

#include <memory>

#include "stages/gel/press/solve/linear_solver.h"

namespace tacipc {

/// Direct solver: orders and analyses once per pattern and factorises in every prepare(). It uses one thread, because
/// CHOLMOD and BLAS change the last bits of a result with the number of threads.
class CholmodSolver final : public LinearSolver {
 public:
  CholmodSolver();
  ~CholmodSolver() override;
  CholmodSolver(const CholmodSolver&) = delete;
  CholmodSolver& operator=(const CholmodSolver&) = delete;

  /// Factorises. \throw SolverError if out of memory or on an internal error
  bool prepare(const BlockMatrix& matrix, const std::vector<char>* changed = nullptr) override;
  /// A⁻¹ b by the last factorisation; never empty.
  std::optional<Eigen::VectorXd> solve(const Eigen::VectorXd& b) override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace tacipc
