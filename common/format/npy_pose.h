// Poses as numbers of an array: 4 × 4, row-major.
#pragma once

#include <vector>

#include "common/base/types.h"

namespace tacipc {

/// Appends a pose to numbers.
inline void append_pose(std::vector<double>& numbers, const Matrix4& pose) {
  for (int i = 0; i < 16; ++i) numbers.push_back(pose(i / 4, i % 4));
}

/// Reads a pose.
/// \pre sixteen numbers follow
inline Matrix4 pose_of(const double* numbers) {
  return Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(numbers);
}

}  // namespace tacipc
