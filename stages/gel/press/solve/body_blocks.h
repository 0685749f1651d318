// Blocks of free bodies in the preconditioner of conjugate gradients.
#pragma once

#include <vector>

#include "stages/gel/press/solve/sweep_order.h"

namespace tacipc {

/// The 12 × 12 diagonal blocks D = E Eᵀ of the bodies, and scaling of rows and columns by E⁻¹. A body's stiffness
/// against strain is much larger than the forces that hold it in place: with one 3 × 3 block per control point, D would
/// let the body move only as far as one control point could with the others held.
/// Vectors and scaled blocks are laid out as in ConjugateGradient; a body's rows have the same positions in the sweeps
/// and in the matrix.
class BodyBlocks {
 public:
  static constexpr int kRows = BlockPattern::kBodyRows;

  /// Factorises the blocks. \return rows of the bodies whose block is not positive definite
  std::vector<int> factorise(const BlockMatrix& matrix);
  int size() const { return static_cast<int>(inverse_.size()); }

  /// Writes the scaled blocks of the bodies' rows in columns first … last − 1 of the sweeps: E⁻¹ B C⁻ᵀ, or E⁻¹ B E⁻ᵀ
  /// between two bodies. Zero blocks and blocks within a body are left unchanged.
  void scale(const BlockMatrix& matrix, const SweepOrder& order, int first, int last,
             const AlignedVector<double>& inverse_cholesky, std::vector<float>& lower) const;
  /// Sets x = E⁻¹ x, or E⁻ᵀ x, in the bodies' rows.
  void unscale(bool transposed, AlignedVector<double>& x) const;

 private:
  using Block = Eigen::Matrix<double, 3 * kRows, 3 * kRows>;

  int first_row_ = 0;
  std::vector<Block> inverse_;  // E⁻¹ of each body
};

}  // namespace tacipc
