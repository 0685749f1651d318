// Symmetric sparse matrix of 3 × 3 blocks over the free vertices; only the lower triangle of blocks is kept.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

#include "common/types.h"

namespace tacipc {

/// Which vertices move freely, and their numbers among those.
struct FreeVertices {
  std::vector<int> free_of_vertex;  // −1 for a vertex whose position is prescribed
  std::vector<int> vertex_of_free;

  /// All of `num_vertices` but those marked as fixed.
  FreeVertices(int num_vertices, const std::vector<bool>& fixed);
  int size() const { return static_cast<int>(vertex_of_free.size()); }
};

/// Positions of the blocks: column by column, rows ascending from the diagonal on.
struct BlockPattern {
  std::vector<int> column_start;  // size + 1
  std::vector<int> row;

  int size() const { return static_cast<int>(column_start.size()) - 1; }
  int num_blocks() const { return static_cast<int>(row.size()); }
  /// Index of block (row, column), row ≥ column, or −1 where there is none.
  int find(int r, int column) const;
};

/// Pattern with every diagonal block and every listed pair of free vertices (in any order, repeated or not).
BlockPattern make_block_pattern(int size, std::vector<std::array<int, 2>> pairs);

struct BlockMatrix {
  std::shared_ptr<const BlockPattern> pattern;
  std::vector<double> values;  // 9 per block, column-major

  explicit BlockMatrix(std::shared_ptr<const BlockPattern> p)
      : pattern(std::move(p)), values(9 * static_cast<std::size_t>(pattern->num_blocks()), 0.0) {}
  Eigen::Map<Matrix3> block(int index) {
    return Eigen::Map<Matrix3>(values.data() + 9 * static_cast<std::size_t>(index));
  }
  /// y = A x for the whole symmetric matrix.
  Eigen::VectorXd multiply(const Eigen::VectorXd& x) const;
};

}  // namespace tacipc
