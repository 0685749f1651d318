// Conjugate gradients with bodies, each a block of 12 × 12: against dense algebra, and against blocks of 3 × 3.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "stages/gel/press/solve/conjugate_gradient.h"
#include "tests/stages/gel/press/solve/block_matrices.h"

namespace tacipc {
namespace body_blocks_test {

constexpr int kSmall = 60, kInParts = 4400;  // gel rows: swept as one, and in parts

Eigen::VectorXd some_load(const BlockMatrix& matrix) {
  return (Eigen::ArrayXd::LinSpaced(3 * matrix.pattern->size(), 0.0, 70.0)).sin();
}

/// The same matrix without the knowledge that its last rows are bodies.
BlockMatrix without_bodies(const BlockMatrix& matrix) {
  auto pattern = std::make_shared<BlockPattern>(*matrix.pattern);
  pattern->num_bodies = 0;
  BlockMatrix out(pattern);
  out.values = matrix.values;
  return out;
}

/// Products of preconditioned conjugate gradients by dense algebra with M = (D + L) D⁻¹ (D + Lᵀ).
int dense_products(const BlockMatrix& matrix, const Eigen::VectorXd& b, double tolerance) {
  const Eigen::MatrixXd A = dense(matrix);
  Eigen::MatrixXd D = Eigen::MatrixXd::Zero(A.rows(), A.rows()), lower = D;  // D + L
  const Eigen::Index first_body = 3 * matrix.pattern->first_body_row();
  for (Eigen::Index at = 0, size = 3; at < A.rows(); at += size) {
    size = at < first_body ? 3 : 12;
    D.block(at, at, size, size) = A.block(at, at, size, size);
    lower.block(at, at, A.rows() - at, size) = A.block(at, at, A.rows() - at, size);
  }
  const Eigen::LLT<Eigen::MatrixXd> M(lower * D.llt().solve(lower.transpose()));
  Eigen::VectorXd r = b, z = M.solve(r), p = z;
  double rz = r.dot(z);
  int products = 0;
  for (const double target = tolerance * tolerance * rz; rz > target; ++products) {
    const Eigen::VectorXd Ap = A * p;
    r -= rz / p.dot(Ap) * Ap;
    z = M.solve(r);
    const double last = rz;
    rz = r.dot(z);
    p = z + rz / last * p;
  }
  return products;
}

TEST(BodyBlocks, AColumnHasAllRowsOfABodyOrNone) {
  const BlockPattern pattern = make_block_pattern(13, {{1, 7}, {0, 1}, {9, 2}, {6, 12}, {3, 10}, {3, 5}}, 2);
  EXPECT_EQ(pattern.first_body_row(), 5);
  for (int c = 0; c < 13; ++c) {
    for (int r = c; r < 13; ++r) {
      const bool first_body = r >= 5 && r < 9 && (c == 1 || c == 3 || c >= 5);
      const bool second_body = r >= 9 && (c == 2 || c == 3 || c >= 5);
      EXPECT_EQ(pattern.find(r, c) >= 0, r == c || (r == 1 && c == 0) || first_body || second_body) << r << ' ' << c;
    }
  }
}

TEST(BodyBlocks, SolvesAsDenseAlgebraDoes) {
  for (const int bodies : {1, 2, 3}) {
    const BlockMatrix matrix = matrix_with_bodies(kSmall, bodies, 1e5);
    const Eigen::VectorXd b = some_load(matrix), exact = dense(matrix).ldlt().solve(b);
    for (const double tolerance : {1e-3, 1e-8}) {
      ConjugateGradient solver(tolerance);
      ASSERT_TRUE(solver.prepare(matrix));
      const Eigen::VectorXd x = solver.solve(b).value();
      EXPECT_LT((x - exact).norm(), 30.0 * tolerance * exact.norm()) << bodies;
      EXPECT_EQ(solver.num_factorized(), 0);
    }
  }
}

TEST(BodyBlocks, TakesAsManyProductsAsDenseAlgebraWithThatPreconditioner) {
  for (const int bodies : {1, 2, 3}) {
    const BlockMatrix matrix = matrix_with_bodies(kSmall, bodies, 1e5);
    const Eigen::VectorXd b = some_load(matrix);
    ConjugateGradient solver(1e-3);
    ASSERT_TRUE(solver.prepare(matrix));
    ASSERT_TRUE(solver.solve(b).has_value());
    EXPECT_EQ(solver.num_products(), dense_products(matrix, b, 1e-3)) << bodies;
  }
}

TEST(BodyBlocks, SolvesInPartsWithTheSameBitsOnAnyNumberOfThreads) {
  for (const int bodies : {1, 2}) {
    const BlockMatrix matrix = matrix_with_bodies(kInParts, bodies, 1e5);
    const Eigen::VectorXd b = some_load(matrix);
    const auto with = [&](std::size_t threads) {
      const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
      ConjugateGradient solver(1e-10);
      EXPECT_TRUE(solver.prepare(matrix));
      return solver.solve(b).value();
    };
    const Eigen::VectorXd one = with(1);
    EXPECT_LT((matrix.multiply(one) - b).norm(), 1e-8 * b.norm()) << bodies;
    for (const std::size_t threads : {2, 3, 4, 5}) EXPECT_EQ(one, with(threads)) << bodies << ' ' << threads;
  }
}

TEST(BodyBlocks, StiffBodiesCostNoMoreProductsThanSoftOnes) {
  for (const int rows : {kSmall, kInParts}) {
    for (const int bodies : {1, 2}) {
      const auto products = [&](const BlockMatrix& matrix) {
        ConjugateGradient solver(1e-4);
        EXPECT_TRUE(solver.prepare(matrix));
        EXPECT_TRUE(solver.solve(some_load(matrix)).has_value());
        EXPECT_EQ(solver.num_factorized(), 0);
        return static_cast<int>(solver.num_products());
      };
      const BlockMatrix soft = matrix_with_bodies(rows, bodies, 1.0), stiff = matrix_with_bodies(rows, bodies, 1e5);
      EXPECT_LE(products(stiff), products(soft) + 2) << rows << " rows, bodies: " << bodies;
      EXPECT_GT(products(without_bodies(stiff)), 1.5 * products(stiff)) << rows << " rows, bodies: " << bodies;
    }
  }
}

/// The solver is used again for matrices of another size.
TEST(BodyBlocks, NothingIsLeftOfTheMatrixBefore) {
  ConjugateGradient used(1e-6), fresh(1e-6);
  const BlockMatrix larger = matrix_with_bodies(kSmall + 20, 1, 1e3), matrix = matrix_with_bodies(kSmall, 2, 1e3);
  ASSERT_TRUE(used.prepare(larger));
  used.solve(some_load(larger));
  ASSERT_TRUE(used.prepare(matrix));
  ASSERT_TRUE(fresh.prepare(matrix));
  EXPECT_EQ(used.solve(some_load(matrix)), fresh.solve(some_load(matrix)));
}

TEST(BodyBlocks, SaysWhichBodyIsNotPositiveDefinite) {
  // Each of its blocks of 3 × 3 is, the twelve rows are not.
  BlockMatrix matrix = matrix_with_bodies(kSmall, 2, 1e3);
  for (int k = 0; k < 3; ++k) matrix.block(kSmall + 7, kSmall + 4)(k, k) += 1e5;
  ASSERT_EQ(Eigen::LLT<Matrix3>(matrix.block(kSmall + 7, kSmall + 7)).info(), Eigen::Success);
  ConjugateGradient solver;
  EXPECT_FALSE(solver.prepare(matrix));
  EXPECT_EQ(solver.indefinite_rows(), (std::vector<int>{kSmall + 4, kSmall + 5, kSmall + 6, kSmall + 7}));
  matrix = matrix_with_bodies(kSmall, 2, 1e3);
  matrix.block(kSmall + 1, kSmall)(0, 0) = std::nan("");
  EXPECT_FALSE(solver.prepare(matrix));
  EXPECT_EQ(solver.indefinite_rows(), (std::vector<int>{kSmall, kSmall + 1, kSmall + 2, kSmall + 3}));

  // Seen in the iterations: the body and a vertex of the gel pull at each other more than they hold.
  matrix = matrix_with_bodies(kSmall, 2, 1e3);
  const int touched = kSmall / 2 + kSmall / 80;  // by the first body
  ASSERT_GE(matrix.pattern->find(kSmall + 2, touched), 0);
  matrix.block(kSmall + 2, touched) = 1e4 * Matrix3::Identity();
  ASSERT_TRUE(solver.prepare(matrix));
  EXPECT_FALSE(solver.solve(some_load(matrix)).has_value());
  std::vector<int> rows = solver.indefinite_rows();
  std::erase(rows, touched);
  EXPECT_EQ(rows, (std::vector<int>{kSmall, kSmall + 1, kSmall + 2, kSmall + 3}));
}

}  // namespace body_blocks_test
}  // namespace tacipc
