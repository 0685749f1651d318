// Factorisation against dense algebra.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "stages/gel/press/solve/cholmod_solver.h"
#include "tests/stages/gel/press/solve/block_matrices.h"

namespace tacipc {
namespace cholmod_solver_test {

TEST(CholmodSolver, SolvesAsDenseAlgebraDoes) {
  BlockMatrix matrix = random_matrix(40, 3, 20.0);
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(120, -1.0, 2.0);
  CholmodSolver solver;
  ASSERT_TRUE(solver.prepare(matrix));
  const Eigen::MatrixXd A = dense(matrix);
  EXPECT_LT((A - A.transpose()).norm(), 1e-14 * A.norm());
  EXPECT_LT((solver.solve(b).value() - A.ldlt().solve(b)).norm(), 1e-12);
  for (double& value : matrix.values) value *= 2.0;
  ASSERT_TRUE(solver.prepare(matrix));
  EXPECT_LT((A * solver.solve(b).value() * 2.0 - b).norm(), 1e-12);
}

TEST(CholmodSolver, SaysWhenAMatrixIsNotPositiveDefiniteAndRecovers) {
  CholmodSolver solver;
  EXPECT_FALSE(solver.prepare(random_matrix(40, 3, -20.0)));
  EXPECT_FALSE(solver.prepare(random_matrix(40, 3, 0.1)));
  EXPECT_TRUE(solver.prepare(random_matrix(40, 3, 20.0)));
}

}  // namespace cholmod_solver_test
}  // namespace tacipc
