// Preconditioned conjugate gradients against dense algebra, at any number of threads.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <Eigen/Cholesky>
#include <random>

#include "stages/gel/press/solve/conjugate_gradient.h"
#include "tests/stages/gel/press/solve/block_matrices.h"

namespace tacipc {
namespace conjugate_gradient_test {

TEST(ConjugateGradient, SolvesAsDenseAlgebraDoesToItsToleranceWithoutAFactor) {
  BlockMatrix matrix = random_matrix(12, 3, 20.0);
  const Eigen::MatrixXd A = dense(matrix);
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(A.rows(), -1.0, 2.0), exact = A.ldlt().solve(b);
  for (const double tolerance : {1e-3, 1e-6, 1e-12}) {
    ConjugateGradient solver(tolerance);
    ASSERT_TRUE(solver.prepare(matrix));
    const Eigen::VectorXd x = solver.solve(b).value();
    EXPECT_LT((x - exact).norm(), 30.0 * tolerance * exact.norm());
    EXPECT_NEAR(x.dot(A * x), x.dot(b), 1e-9 * x.dot(b));  // what keeps a Newton step downhill
    EXPECT_EQ(solver.num_factorized(), 0);
    EXPECT_GT(solver.num_products(), 0);
  }
}

/// Marks say which rows have changed, also where the matrix was not positive definite in between.
TEST(ConjugateGradient, PreparesWhatHasChangedAsIfAllHad) {
  BlockMatrix matrix = random_matrix(40, 3, 20.0);
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(120, -1.0, 2.0);
  const auto anew = [&] {
    ConjugateGradient fresh(1e-4);
    EXPECT_TRUE(fresh.prepare(matrix));
    return fresh.solve(b).value();
  };
  ConjugateGradient solver(1e-4);
  ASSERT_TRUE(solver.prepare(matrix));
  ASSERT_EQ(solver.solve(b).value(), anew());
  std::vector<char> changed(40, 0);
  // A block between two rows.
  const int column = 10, row = matrix.pattern->row[matrix.pattern->column_start[column] + 1];
  ASSERT_GT(row, column);
  matrix.block(row, column) *= -1.5;
  changed[column] = changed[row] = 1;
  const Eigen::VectorXd before = solver.solve(b).value();
  ASSERT_TRUE(solver.prepare(matrix, &changed));
  EXPECT_EQ(solver.solve(b).value(), anew());
  EXPECT_NE(solver.solve(b).value(), before);
  // A block on the diagonal that must not be, and then another.
  std::fill(changed.begin(), changed.end(), 0);
  const Matrix3 was = matrix.block(25, 25);
  matrix.block(25, 25) *= -1.0;
  changed[25] = 1;
  EXPECT_FALSE(solver.prepare(matrix, &changed));
  matrix.block(25, 25) = 2.0 * was;
  matrix.block(30, 30) *= 1.5;
  changed[30] = 1;
  EXPECT_TRUE(solver.prepare(matrix, &changed));
  EXPECT_EQ(solver.solve(b).value(), anew());
  // What one call was told of and could not use, the next need not be.
  matrix.block(25, 25) *= -1.0;
  std::fill(changed.begin(), changed.end(), 0);
  changed[25] = changed[30] = 1;
  matrix.block(30, 30) *= 0.5;
  EXPECT_FALSE(solver.prepare(matrix, &changed));
  changed[30] = 0;
  matrix.block(25, 25) *= -1.0;
  EXPECT_TRUE(solver.prepare(matrix, &changed));
  EXPECT_EQ(solver.solve(b).value(), anew());
}

/// Large enough to be swept in parts.
TEST(ConjugateGradient, GivesTheSameBitsWithAnyNumberOfThreads) {
  BlockMatrix matrix(std::make_shared<BlockPattern>(chain(6000)));
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int c = 0; c < 6000; ++c) {
    for (int k = matrix.pattern->column_start[c]; k < matrix.pattern->column_start[c + 1]; ++k) {
      auto block = matrix.block(k);
      for (double& entry : block.reshaped()) entry = uniform(random);
      if (matrix.pattern->row[k] == c) block = (0.5 * (block + block.transpose())).eval() + 9.0 * Matrix3::Identity();
    }
  }
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(18000, -1.0, 2.0);
  const auto with = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    ConjugateGradient solver(1e-10);
    EXPECT_TRUE(solver.prepare(matrix));
    return solver.solve(b).value();
  };
  const Eigen::VectorXd one = with(1), two = with(2);
  EXPECT_EQ(one, two);
  EXPECT_LT((matrix.multiply(one) - b).norm(), 1e-8 * b.norm());
}

TEST(ConjugateGradient, FactorisesWhereItsProductsDoNotSuffice) {
  BlockMatrix matrix = random_matrix(12, 3, 20.0);
  const Eigen::MatrixXd A = dense(matrix);
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(A.rows(), -1.0, 2.0);
  ConjugateGradient solver(1e-3, 1);
  ASSERT_TRUE(solver.prepare(matrix));
  EXPECT_LT((solver.solve(b).value() - A.ldlt().solve(b)).norm(), 1e-11);
  EXPECT_EQ(solver.num_factorized(), 1);
}

TEST(ConjugateGradient, SaysWhenAMatrixIsNotPositiveDefinite) {
  BlockMatrix block = random_matrix(4, 3, 20.0);
  block.block(block.pattern->find(2, 2)) -= 100.0 * Matrix3::Identity();
  EXPECT_FALSE(ConjugateGradient().prepare(block));

  // Every block on the diagonal is positive, the whole is not.
  BlockMatrix whole(std::make_shared<const BlockPattern>(make_block_pattern(2, {{0, 1}})));
  whole.block(0) = whole.block(2) = Matrix3::Identity();
  whole.block(1) = 2.0 * Matrix3::Identity();
  ConjugateGradient solver;
  ASSERT_TRUE(solver.prepare(whole));
  Eigen::VectorXd b(6);
  b << 1, 0, 0, -1, 0, 0;
  EXPECT_FALSE(solver.solve(b).has_value());
}

TEST(ConjugateGradient, SaysWhereAMatrixIsNotPositiveDefinite) {
  BlockMatrix matrix = random_matrix(40, 3, 20.0);
  ConjugateGradient solver;
  ASSERT_TRUE(solver.prepare(matrix));
  EXPECT_TRUE(solver.indefinite_rows().empty());
  // Seen at once: a block on the diagonal.
  matrix.block(17, 17)(1, 1) = -1.0;
  EXPECT_FALSE(solver.prepare(matrix));
  EXPECT_EQ(solver.indefinite_rows(), (std::vector<int>{17}));
  // Seen in the iterations: two that pull at each other more than they hold.
  matrix = random_matrix(40, 3, 20.0);
  matrix.block(25, 24).setIdentity();
  matrix.block(25, 24) *= 40.0;
  ASSERT_TRUE(solver.prepare(matrix));
  EXPECT_FALSE(solver.solve(Eigen::VectorXd::LinSpaced(120, -1.0, 2.0)));
  ASSERT_FALSE(solver.indefinite_rows().empty());
  for (const int row : solver.indefinite_rows()) EXPECT_TRUE(row == 24 || row == 25) << row;
}

}  // namespace conjugate_gradient_test
}  // namespace tacipc
