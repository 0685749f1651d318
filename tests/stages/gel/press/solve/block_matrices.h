// Block matrices and patterns that the tests of the linear solvers share.
#pragma once

#include <Eigen/Core>
#include <random>

#include "stages/gel/press/solve/block_matrix.h"

namespace tacipc {

/// A random symmetric block matrix, diagonally dominant, with some blocks off the diagonal.
inline BlockMatrix random_matrix(int size, unsigned seed, double diagonal) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<std::array<int, 2>> pairs;
  for (int i = 0; i < size; ++i) {
    pairs.push_back({i, (i + 1) % size});
    pairs.push_back({(i * 7 + 3) % size, i});
  }
  BlockMatrix matrix(std::make_shared<BlockPattern>(make_block_pattern(size, pairs)));
  for (int c = 0; c < size; ++c) {
    for (int k = matrix.pattern->column_start[c]; k < matrix.pattern->column_start[c + 1]; ++k) {
      auto block = matrix.block(k);
      for (double& entry : block.reshaped()) entry = uniform(random);
      if (matrix.pattern->row[k] == c)
        block = (0.5 * (block + block.transpose())).eval() + diagonal * Matrix3::Identity();
    }
  }
  return matrix;
}

inline Eigen::MatrixXd dense(const BlockMatrix& matrix) {
  const Eigen::Index n = 3 * matrix.pattern->size();
  Eigen::MatrixXd out(n, n);
  for (Eigen::Index i = 0; i < n; ++i) out.col(i) = matrix.multiply(Eigen::VectorXd::Unit(n, i));
  return out;
}

/// A row of vertices, each coupled with the next two and a few far away.
inline BlockPattern chain(int size) {
  std::vector<std::array<int, 2>> pairs;
  for (int i = 0; i + 2 < size; ++i) {
    pairs.push_back({i, i + 1});
    pairs.push_back({i + 2, i});
    if (i % 97 == 5) pairs.push_back({i, (i + size / 2) % size});
  }
  return make_block_pattern(size, pairs);
}

}  // namespace tacipc
