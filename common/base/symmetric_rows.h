// Symmetric tensors of a mesh's tetrahedra.
#pragma once

#include "common/base/types.h"

namespace tacipc {

/// Symmetric 3 × 3 tensors, one row per tetrahedron: xx yy zz yz xz xy.
using SymmetricRows = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;

/// Returns the tensor of tetrahedron t as a matrix.
inline Matrix3 symmetric(const SymmetricRows& rows, Eigen::Index t) {
  const auto r = rows.row(t);
  return Matrix3{{r[0], r[5], r[4]}, {r[5], r[1], r[3]}, {r[4], r[3], r[2]}};
}

}  // namespace tacipc
