// Values that were simulated on a grid of parameters, in between.
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
  /// Of each node at a point: the product of Lagrange's polynomials through all values of each axis. They sum to 1, and
  /// give a polynomial of each parameter of a degree below the number of its values exactly.
  Eigen::VectorXd weights(const std::vector<double>& at) const;

 private:
  std::vector<std::vector<double>> axes_;
};

/// A ball's force to this power is nearly linear in its depth.
inline constexpr double kPressExponent = 2.0 / 3.0;

/// A curve through (0, 0): a monotone cubic (Fritsch and Carlson 1980) of y^exponent; beyond the last place on along
/// its last slope.
class Curve {
 public:
  /// \pre x ascends from 0, at least 3 places; y(0) = 0
  Curve(const std::vector<double>& x, const Eigen::VectorXd& y, double exponent);
  double at(double place) const;

 private:
  double exponent_;
  std::vector<double> x_, root_, slope_;
};

/// One curve per node, all at the same places, each zero at zero.
struct CurveTable {
  std::vector<double> x;  // ascending from 0
  Eigen::MatrixXd y;      // node, place
  double exponent = kPressExponent;

  /// That which these weights of the nodes make.
  Curve blend(const Eigen::VectorXd& weights) const { return {x, y.transpose() * weights, exponent}; }
};

}  // namespace tacipc
