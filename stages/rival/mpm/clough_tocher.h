// Cubic interpolation of scattered values on a triangulation, with a continuous gradient: the method `cubic` of SciPy's
// griddata.   [Clough and Tocher 1965; gradients: Nielson 1983, Renka 1984; edge directions: SciPy]
#pragma once

#include <vector>

#include "common/base/types.h"

namespace tacipc {

using Points2 = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;

/// Gradients at the points of a triangulation that minimise the bending of the cubics along its edges,
///   Σ_edges ∫₀¹ w″(t)² dt / L³.
/// The solver sweeps over the points until no gradient changes by more than 10⁻⁶, relative to its largest component if
/// that is above 1. Points in no triangle have zero gradients.
Points2 least_bending_gradients(const Points2& points, const Eigen::VectorXd& values, const Triangles& triangles);

/// Interpolant over the triangles.
class CloughTocher {
 public:
  /// \pre triangles are counter-clockwise and have an area
  CloughTocher(const Points2& points, const Eigen::VectorXd& values, const Triangles& triangles);

  /// Barycentric coordinates of a point in a triangle.
  Vector3 barycentric(Eigen::Index triangle, const Eigen::Vector2d& point) const;
  /// Interpolated value in a triangle at barycentric coordinates (≥ 0, sum 1).
  double value(Eigen::Index triangle, const Vector3& barycentric) const;

 private:
  /// Control values of the cubic over the part of a triangle between its edge i, j and its centroid c.
  struct Part {
    double iii, iij, ijj, jjj, iic, ijc, jjc, icc, jcc, ccc;
  };
  Eigen::Vector2d corner(Eigen::Index triangle, int k) const { return points_.row(triangles_(triangle, k)); }

  Points2 points_;
  Triangles triangles_;
  std::vector<Part> parts_;  // three per triangle: part k lies opposite to corner k; i and j follow k
};

}  // namespace tacipc
