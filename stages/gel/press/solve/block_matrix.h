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

/// A body whose vertices follow four free control points: x = Σₖ βₖ pₖ.
struct CarriedBody {
  int first_vertex = 0;  // first of the body's rows in the positions; its rows are consecutive
  Eigen::Matrix<double, Eigen::Dynamic, 4> weights;  // weights β of each vertex
  int first_control_point = 0;                       // first row of the four control points

  bool has(int vertex) const { return vertex >= first_vertex && vertex < first_vertex + weights.rows(); }
  /// Sets the body's rows to Σₖ βₖ pₖ, for positions or for displacements.
  void carry(Positions& x) const {
    x.middleRows(first_vertex, weights.rows()) = weights * x.middleRows<4>(first_control_point);
  }
};

/// Numbering of the vertices that are free.
struct FreeVertices {
  /// Number among the free vertices; −1 if the position is prescribed or follows from others.
  std::vector<int> free_of_vertex;
  std::vector<int> vertex_of_free;      // inverse of free_of_vertex
  std::vector<CarriedBody> carried;     // bodies with free control points; these are the last ones of vertex_of_free
  std::vector<int> gel_of_vertex;       // gel of each gel vertex if there are several gels; else empty
  std::vector<bool> gel_without_mount;  // whether a gel has no mount, one per gel
  int num_control_points = 0;  // number of control points, free or not; they are the last rows of the positions

  /// Numbers the vertices of `order` that are not fixed, in that order. \param fixed one mark per vertex
  FreeVertices(const std::vector<int>& order, const std::vector<bool>& fixed);
  int size() const { return static_cast<int>(vertex_of_free.size()); }
  /// Body to which a vertex belongs; null if there is none.
  const CarriedBody* carrier(int vertex) const {
    for (const CarriedBody& body : carried) {
      if (body.has(vertex)) return &body;
    }
    return nullptr;
  }
};

/// Positions of the blocks, column by column, with rows ascending from the diagonal on.
struct BlockPattern {
  static constexpr int kBodyRows = 4;  // control points per body

  std::vector<int> column_start;  // first block of each column; size + 1 entries
  std::vector<int> row;           // row of each block
  /// Number of bodies; their rows are the last ones. A column with a block in one row of a body has one in each of its
  /// rows.
  int num_bodies = 0;

  int size() const { return static_cast<int>(column_start.size()) - 1; }
  int num_blocks() const { return static_cast<int>(row.size()); }
  int first_body_row() const { return size() - kBodyRows * num_bodies; }
  /// Index of block (row, column), row ≥ column; −1 if there is none.
  int find(int r, int column) const;
};

/// Pattern with every diagonal block and every listed pair of free vertices, in any order, repeated or not. The last
/// vertices are the control points of `num_bodies` bodies: a pair with one of them is a pair with each.
BlockPattern make_block_pattern(int size, const std::vector<std::array<int, 2>>& pairs, int num_bodies = 0);

/// Symmetric matrix: values of the blocks of a pattern.
struct BlockMatrix {
  /// Numbers per block: three columns of three and a zero, so that a column is one load.
  static constexpr std::size_t kStride = 12;
  using Block = Eigen::Map<Matrix3, 0, Eigen::OuterStride<4>>;
  using ConstBlock = Eigen::Map<const Matrix3, 0, Eigen::OuterStride<4>>;

  std::shared_ptr<const BlockPattern> pattern;
  AlignedVector<double> values;

  BlockMatrix() = default;
  explicit BlockMatrix(std::shared_ptr<const BlockPattern> p) { clear(std::move(p)); }
  /// Resets it to zeros with this pattern.
  void clear(std::shared_ptr<const BlockPattern> p);
  Block block(int index) { return Block(values.data() + kStride * static_cast<std::size_t>(index)); }
  /// Block (row, column), row ≥ column. \throw std::logic_error if the pattern has none
  Block block(int r, int column) {
    const int index = pattern->find(r, column);
    if (index < 0) throw std::logic_error("a block outside the matrix's pattern");
    return block(index);
  }
  ConstBlock block(int index) const { return ConstBlock(values.data() + kStride * static_cast<std::size_t>(index)); }

  /// A x for the whole symmetric matrix: reference for tests of faster code.
  Eigen::VectorXd multiply(const Eigen::VectorXd& x) const;
};

}  // namespace tacipc
