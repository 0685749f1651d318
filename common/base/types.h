// Array types that all stages share: one row per vertex, triangle or tetrahedron.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace tacipc {

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;
using Matrix4 = Eigen::Matrix4d;

/// #V × 3, row i is vertex i, in metres unless a name states another unit.
using Positions = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
/// #F × 3 vertex indices, counter-clockwise seen from outside.
using Triangles = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;
/// #T × 4 vertex indices, positively oriented: det[x1 − x0, x2 − x0, x3 − x0] > 0.
using Tetrahedra = Eigen::Matrix<int, Eigen::Dynamic, 4, Eigen::RowMajor>;

}  // namespace tacipc
