// Blocks of the bodies that move freely in the preconditioner of conjugate gradients.
#pragma once

#include <vector>

#include "stages/gel/press/solve/sweep_order.h"

namespace tacipc {

/// The 12 × 12 blocks D = E Eᵀ of the bodies on the diagonal of a matrix, and rows and columns scaled by E⁻¹. A body's
/// stiffness against strain is many times what holds it in place: taken point by point, D lets it move only as far as
/// one point could with the others held.
/// Vectors and scaled blocks are laid out as ConjugateGradient has them; a body's rows have the same places in the
/// sweeps as in the matrix.
class BodyBlocks {
 public:
  static constexpr int kRows = BlockPattern::kBodyRows;

  /// \return rows of the bodies whose block is not positive definite
  std::vector<int> factorise(const BlockMatrix& matrix);
  int size() const { return static_cast<int>(inverse_.size()); }

  /// Writes the scaled blocks of the bodies' rows in columns first … last − 1 of the sweeps: E⁻¹ B C⁻ᵀ, or E⁻¹ B E⁻ᵀ
  /// between two bodies. Blocks that are zero, and those within a body, are left as they are.
  void scale(const BlockMatrix& matrix, const SweepOrder& order, int first, int last,
             const AlignedVector<double>& inverse_cholesky, std::vector<float>& lower) const;
  /// x = E⁻¹ x, or E⁻ᵀ x, in the bodies' rows.
  void unscale(bool transposed, AlignedVector<double>& x) const;

 private:
  using Block = Eigen::Matrix<double, 3 * kRows, 3 * kRows>;

  int first_row_ = 0;
  std::vector<Block> inverse_;  // E⁻¹ of each
};

}  // namespace tacipc
