// How Newton's linear systems are solved: a choice of the configuration.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "stages/gel/press/solve/block_matrix.h"

namespace tacipc {

enum class LinearSolverKind {
  direct,              // sparse Cholesky, to rounding
  conjugate_gradient,  // to a part of the right-hand side, without a factor
};

/// Solves A x = b for symmetric positive definite A, and says where A turns out not to be.
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;

  /// False if the matrix is seen not to be positive definite. It must outlive the solves with it.
  /// \param changed null, or marks for all rows: since the last call only blocks in a marked row or column have changed
  virtual bool prepare(const BlockMatrix& matrix, const std::vector<char>* changed = nullptr) = 0;
  /// Empty if the matrix turns out not to be positive definite. \pre it was prepared.
  virtual std::optional<Eigen::VectorXd> solve(const Eigen::VectorXd& b) = 0;
  /// Where the matrix was seen not to be positive definite when prepare or solve last said so: rows of blocks,
  /// ascending. Empty if that is not known.
  virtual std::vector<int> indefinite_rows() const { return {}; }
  /// How exactly an iterative solver solves from now on, relative to the right-hand side.
  virtual void set_tolerance(double /*relative*/) {}

  /// Matrix–vector products so far, where it solves by them.
  virtual std::int64_t num_products() const { return 0; }
  /// Systems that an iterative solver had to leave to a factorisation.
  virtual int num_factorized() const { return 0; }
};

std::unique_ptr<LinearSolver> make_linear_solver(LinearSolverKind kind);

}  // namespace tacipc
