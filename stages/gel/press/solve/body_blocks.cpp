#include "stages/gel/press/solve/body_blocks.h"

#include <Eigen/Cholesky>
#include <algorithm>

namespace tacipc {

std::vector<int> BodyBlocks::factorise(const BlockMatrix& matrix) {
  const BlockPattern& pattern = *matrix.pattern;
  first_row_ = pattern.first_body_row();
  inverse_.resize(static_cast<std::size_t>(pattern.num_bodies));
  std::vector<int> indefinite;
  for (int i = 0; i < pattern.num_bodies; ++i) {
    const int first = first_row_ + kRows * i;
    Block D = Block::Zero();
    for (int c = 0; c < kRows; ++c) {
      // A column begins with the body's own rows.
      for (int r = c; r < kRows; ++r)
        D.block<3, 3>(3 * r, 3 * c) = matrix.block(pattern.column_start[first + c] + r - c);
    }
    const Eigen::LLT<Block> factor(D);
    const Block E = factor.matrixL();
    if (factor.info() == Eigen::Success && (E.diagonal().array() > 0.0).all()) {  // false if an entry is NaN
      inverse_[i] = E.triangularView<Eigen::Lower>().solve(Block::Identity());
    } else {
      for (int r = 0; r < kRows; ++r) indefinite.push_back(first + r);
    }
  }
  return indefinite;
}

void BodyBlocks::scale(const BlockMatrix& matrix, const SweepOrder& order, int first, int last,
                       const AlignedVector<double>& inverse_cholesky, std::vector<float>& lower) const {
  const auto write = [&](int at, const Matrix3& block) {
    Eigen::Map<Eigen::Matrix3f>(lower.data() + 9 * static_cast<std::ptrdiff_t>(at)) = block.cast<float>();
  };
  for (int c = first; c < std::min(last, first_row_); ++c) {
    const Matrix3 right =
        BlockMatrix::ConstBlock(inverse_cholesky.data() + BlockMatrix::kStride * static_cast<std::size_t>(c))
            .transpose();
    // The bodies' rows are the last ones of a column; those of one body are consecutive, and none is stored transposed.
    for (int k = order.column_start[c + 1] - kRows; k >= order.column_start[c] && order.row[k] >= first_row_;
         k -= kRows) {
      Eigen::Matrix<double, 3 * kRows, 3> B;
      for (int r = 0; r < kRows; ++r) B.middleRows<3>(3 * r) = matrix.block(order.source[k + r]);
      if (B.isZero(0.0)) continue;  // no contact yet
      B = inverse_[(order.row[k] - first_row_) / kRows] * (B * right);
      for (int r = 0; r < kRows; ++r) write(k + r, B.middleRows<3>(3 * r));
    }
  }
  for (int c = std::max(first, first_row_); c < last; c += kRows) {
    const Block right = inverse_[(c - first_row_) / kRows].transpose();
    const int own = kRows - 1;  // blocks below the diagonal within the body in its first column
    for (int k = order.column_start[c] + own; k < order.column_start[c + 1]; k += kRows) {
      // Each of the body's columns has one block fewer than the previous one.
      const auto at = [&](int row, int column) {
        return order.column_start[c + column] + (k - order.column_start[c]) - column + row;
      };
      Block B;
      for (int j = 0; j < kRows; ++j) {
        for (int r = 0; r < kRows; ++r) B.block<3, 3>(3 * r, 3 * j) = matrix.block(order.source[at(r, j)]);
      }
      B = inverse_[(order.row[k] - first_row_) / kRows] * (B * right);
      for (int j = 0; j < kRows; ++j) {
        for (int r = 0; r < kRows; ++r) write(at(r, j), B.block<3, 3>(3 * r, 3 * j));
      }
    }
  }
}

void BodyBlocks::unscale(bool transposed, AlignedVector<double>& x) const {
  for (int i = 0; i < size(); ++i) {
    // Four numbers per row, the last of them zero.
    Eigen::Map<Eigen::Matrix<double, 3, kRows>, 0, Eigen::OuterStride<4>> own(x.data() + 4 * (first_row_ + kRows * i));
    const Eigen::Matrix<double, 3 * kRows, 1> before = own.reshaped();
    if (transposed) {
      own.reshaped() = inverse_[i].transpose() * before;
    } else {
      own.reshaped() = inverse_[i] * before;
    }
  }
}

}  // namespace tacipc
