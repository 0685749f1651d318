// Sparse Cholesky factorisation of a BlockMatrix: CHOLMOD with METIS ordering.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "stages/press/solve/block_matrix.h"

namespace tacipc {

/// Orders and analyses once per pattern; factorises as often as asked. Always one thread: CHOLMOD and BLAS change the
/// last bits of a result with the number of theirs.
class CholmodSolver {
 public:
  CholmodSolver();
  ~CholmodSolver();
  CholmodSolver(const CholmodSolver&) = delete;
  CholmodSolver& operator=(const CholmodSolver&) = delete;

  /// False if the matrix is not positive definite. \throw SolverError when out of memory or on an internal fault.
  bool factorize(const BlockMatrix& matrix);
  /// A⁻¹ b by the last factorisation. \pre it succeeded.
  Eigen::VectorXd solve(const Eigen::VectorXd& b);

  /// Symbolic analyses so far.
  int num_analyses() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace tacipc
