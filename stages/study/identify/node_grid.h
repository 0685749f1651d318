// Interpolates values that were simulated on a grid of parameters.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace tacipc {

/// A grid with a node for every combination of the values of its axes; the first axis varies slowest.
class NodeGrid {
 public:
  /// \pre values of each axis are different
  explicit NodeGrid(std::vector<std::vector<double>> axes) : axes_(std::move(axes)) {}

  Eigen::Index size() const;
  /// Weight of each node at a point: the product of Lagrange's polynomials through all values of each axis. The weights
  /// sum to 1. They are exact for a polynomial of each parameter of a degree below its number of values.
  Eigen::VectorXd weights(const std::vector<double>& at) const;

 private:
  std::vector<std::vector<double>> axes_;
};

/// Exponent with which a ball's force becomes nearly linear in its depth.
inline constexpr double kPressExponent = 2.0 / 3.0;

/// Curve through (0, 0): a monotone cubic (Fritsch and Carlson 1980) of y^exponent, continued linearly beyond the last
/// point.
class Curve {
 public:
  /// \pre x ascends from 0, at least 3 points; y(0) = 0
  Curve(const std::vector<double>& x, const Eigen::VectorXd& y, double exponent);
  double at(double place) const;

 private:
  double exponent_;
  std::vector<double> x_, root_, slope_;
};

/// One curve per node, all at the same points x; each is zero at x = 0.
struct CurveTable {
  std::vector<double> x;  // ascending from 0
  Eigen::MatrixXd y;      // value by node (row) and point (column)
  double exponent = kPressExponent;

  /// Curve that results from these node weights.
  Curve blend(const Eigen::VectorXd& weights) const { return {x, y.transpose() * weights, exponent}; }
};

}  // namespace tacipc
