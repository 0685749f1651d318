// Symmetric sparse matrix of 3 × 3 blocks over the free vertices; only the lower triangle of blocks is kept.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <stdexcept>
#include <vector>

#include "common/base/simd.h"
#include "common/base/types.h"

namespace tacipc {

/// A body whose vertices are where four free points carry them: x = Σₖ βₖ pₖ.
struct CarriedBody {
  int first_vertex = 0;                              // its vertices are neighbouring rows of the positions,
  Eigen::Matrix<double, Eigen::Dynamic, 4> weights;  // β of each
  int first_control_point = 0;                       // rows of the four points

  bool has(int vertex) const { return vertex >= first_vertex && vertex < first_vertex + weights.rows(); }
  /// Sets the body's rows to where the points' rows carry them: of positions, or of displacements.
  void carry(Positions& x) const {
    x.middleRows(first_vertex, weights.rows()) = weights * x.middleRows<4>(first_control_point);
  }
};

/// Which vertices move freely, and their numbers among those.
struct FreeVertices {
  std::vector<int> free_of_vertex;  // −1 for a vertex whose position is prescribed or follows from others
  std::vector<int> vertex_of_free;
  std::vector<CarriedBody> carried;     // bodies whose points are free, the last ones of vertex_of_free
  std::vector<int> gel_of_vertex;       // of the gel's vertices, where there are several gels; else empty
  std::vector<bool> gel_without_mount;  // of each of those
  int num_control_points = 0;           // the last rows of positions: points that carry bodies, free or not

  /// Those of `order` that are not marked as fixed, in that order; `fixed` has a mark for every vertex.
  FreeVertices(const std::vector<int>& order, const std::vector<bool>& fixed);
  int size() const { return static_cast<int>(vertex_of_free.size()); }
  /// The body that carries a vertex, or null.
  const CarriedBody* carrier(int vertex) const {
    for (const CarriedBody& body : carried) {
      if (body.has(vertex)) return &body;
    }
    return nullptr;
  }
};

/// Positions of the blocks: column by column, rows ascending from the diagonal on.
struct BlockPattern {
  static constexpr int kBodyRows = 4;  // a body has that many points

  std::vector<int> column_start;  // size + 1
  std::vector<int> row;
  /// The last rows are those of so many bodies. A column with a block in one row of a body has one in each of them.
  int num_bodies = 0;

  int size() const { return static_cast<int>(column_start.size()) - 1; }
  int num_blocks() const { return static_cast<int>(row.size()); }
  int first_body_row() const { return size() - kBodyRows * num_bodies; }
  /// Index of block (row, column), row ≥ column, or −1 where there is none.
  int find(int r, int column) const;
};

/// Pattern with every diagonal block and every listed pair of free vertices (in any order, repeated or not). The last
/// vertices are the points of `num_bodies` bodies: a pair with one of them is a pair with each.
BlockPattern make_block_pattern(int size, const std::vector<std::array<int, 2>>& pairs, int num_bodies = 0);

struct BlockMatrix {
  /// Numbers per block: three columns of three and a zero, so that a column is one load.
  static constexpr std::size_t kStride = 12;
  using Block = Eigen::Map<Matrix3, 0, Eigen::OuterStride<4>>;
  using ConstBlock = Eigen::Map<const Matrix3, 0, Eigen::OuterStride<4>>;

  std::shared_ptr<const BlockPattern> pattern;
  AlignedVector<double> values;

  BlockMatrix() = default;
  explicit BlockMatrix(std::shared_ptr<const BlockPattern> p) { clear(std::move(p)); }
  /// Makes it a matrix of zeros.
  void clear(std::shared_ptr<const BlockPattern> p);
  Block block(int index) { return Block(values.data() + kStride * static_cast<std::size_t>(index)); }
  /// Block (row, column), row ≥ column. \throw std::logic_error if the pattern has none
  Block block(int r, int column) {
    const int index = pattern->find(r, column);
    if (index < 0) throw std::logic_error("a block outside the matrix's pattern");
    return block(index);
  }
  ConstBlock block(int index) const { return ConstBlock(values.data() + kStride * static_cast<std::size_t>(index)); }

  /// A x for the whole symmetric matrix; faster code is tested against it.
  Eigen::VectorXd multiply(const Eigen::VectorXd& x) const;
};

}  // namespace tacipc
