// Block matrices and patterns that the tests of the linear solvers share.
#pragma once

#include <Eigen/Core>
#include <numeric>
#include <random>

#include "stages/gel/press/solve/block_matrix.h"

namespace tacipc {

/// All vertices but those marked as fixed, numbered by vertex.
inline FreeVertices all_but(const std::vector<bool>& fixed) {
  std::vector<int> order(fixed.size());
  std::iota(order.begin(), order.end(), 0);
  return {order, fixed};
}

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

/// A chain of gel vertices and, last, the points of bodies that resist strain `stiffness` times as much as they are
/// heavy. Each touches gel vertices everywhere, and the body before it.
inline BlockMatrix matrix_with_bodies(int num_gel_rows, int num_bodies, double stiffness) {
  constexpr int kPoints = BlockPattern::kBodyRows;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto vector = [&] { return Eigen::Vector3d(uniform(random), uniform(random), uniform(random)); };
  /// A spring: ½ k (Σ row · x)².
  struct Spring {
    std::vector<int> rows;
    std::vector<Eigen::Vector3d> parts;
    double stiffness;
  };
  std::vector<Spring> springs;
  const auto carry = [&](Spring& spring, int body, const Eigen::Vector3d& normal) {
    for (int k = 0; k < kPoints; ++k) {
      spring.rows.push_back(num_gel_rows + kPoints * body + k);
      spring.parts.push_back((k == 0 ? 0.7 : 0.1) * normal);  // nearest to its first point
    }
  };
  for (int body = 0; body < num_bodies; ++body) {
    for (int contact = 0; contact < 40; ++contact) {
      const Eigen::Vector3d normal = vector();
      Spring spring{{(2 * contact + 1) * num_gel_rows / 80}, {-normal}, 30.0};
      carry(spring, body, normal);
      springs.push_back(spring);
    }
    for (int strain = 0; strain < 6; ++strain) {
      Spring spring{{}, {}, stiffness};
      carry(spring, body, Eigen::Vector3d::Zero());
      for (Eigen::Vector3d& part : spring.parts) part = vector();
      springs.push_back(spring);
    }
    if (body == 0) continue;
    const Eigen::Vector3d normal = vector();
    Spring spring{{}, {}, 30.0};
    carry(spring, body - 1, -normal);
    carry(spring, body, normal);
    springs.push_back(spring);
  }
  const int n = num_gel_rows + kPoints * num_bodies;
  const BlockPattern gel = chain(num_gel_rows);
  std::vector<std::array<int, 2>> pairs;
  for (int c = 0; c < gel.size(); ++c) {
    for (int k = gel.column_start[c]; k < gel.column_start[c + 1]; ++k) pairs.push_back({c, gel.row[k]});
  }
  for (const Spring& spring : springs) pairs.push_back({spring.rows.front(), spring.rows.back()});
  BlockMatrix matrix(std::make_shared<BlockPattern>(make_block_pattern(n, pairs, num_bodies)));
  for (int c = 0; c < num_gel_rows; ++c) {
    for (int k = gel.column_start[c]; k < gel.column_start[c + 1]; ++k) {
      Matrix3 block;
      for (double& entry : block.reshaped()) entry = uniform(random);
      matrix.block(gel.row[k], c) = gel.row[k] == c ? Matrix3(9.0 * Matrix3::Identity()) : block;
    }
  }
  for (int r = num_gel_rows; r < n; ++r) matrix.block(r, r).setIdentity();
  for (const Spring& spring : springs) {
    for (std::size_t i = 0; i < spring.rows.size(); ++i) {
      for (std::size_t j = 0; j <= i; ++j)
        matrix.block(spring.rows[i], spring.rows[j]) +=
            spring.stiffness * spring.parts[i] * spring.parts[j].transpose();
    }
  }
  return matrix;
}

}  // namespace tacipc
