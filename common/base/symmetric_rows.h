// Symmetric tensors of the tetrahedra of a mesh.
#pragma once

#include "common/base/types.h"

namespace tacipc {

/// Symmetric 3 × 3 tensors, one per tetrahedron: a row xx yy zz yz xz xy each.
using SymmetricRows = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;

/// One of them as a matrix.
inline Matrix3 symmetric(const SymmetricRows& rows, Eigen::Index t) {
  const auto r = rows.row(t);
  return Matrix3{{r[0], r[5], r[4]}, {r[5], r[1], r[3]}, {r[4], r[3], r[2]}};
}

}  // namespace tacipc
