// Interface of the linear solvers for Newton's systems; the configuration chooses one.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "stages/gel/press/solve/block_matrix.h"

namespace tacipc {

/// Kind of linear solver.
enum class LinearSolverKind {
  direct,              // sparse Cholesky, to rounding
  conjugate_gradient,  // to a tolerance relative to the right-hand side, without a factor
};

/// Solves A x = b for symmetric positive definite A, and locates rows where A is not positive definite.
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;

  /// Prepares a matrix, which must outlive the solves with it.
  /// \param changed null, or marks for all rows: since the last call only blocks in a marked row or column have changed
  /// \return false if the matrix is found not to be positive definite
  virtual bool prepare(const BlockMatrix& matrix, const std::vector<char>* changed = nullptr) = 0;
  /// Solves A x = b. \pre the matrix was prepared \return nothing if the matrix turns out not to be positive definite
  virtual std::optional<Eigen::VectorXd> solve(const Eigen::VectorXd& b) = 0;
  /// Block rows, ascending, where the matrix was last found not to be positive definite by prepare() or solve(). Empty
  /// if they are not known.
  virtual std::vector<int> indefinite_rows() const { return {}; }
  /// Sets the tolerance of an iterative solver, relative to the right-hand side.
  virtual void set_tolerance(double /*relative*/) {}

  /// Number of matrix–vector products so far, for an iterative solver.
  virtual std::int64_t num_products() const { return 0; }
  /// Number of systems that an iterative solver had to factorise.
  virtual int num_factorized() const { return 0; }
};

/// Creates a solver of this kind with its default tolerance.
std::unique_ptr<LinearSolver> make_linear_solver(LinearSolverKind kind);

}  // namespace tacipc
