// Where the membrane is too flat to shadow itself: rays that need not be traced.
#pragma once

#include <vector>

#include "common/optics/membrane.h"

namespace tacipc {

/// A grid over the membrane as seen along z. For each cell a bound on how steeply anything rises around it, towards the
/// lights: within the cell and its eight neighbours the steepest triangle, farther away the highest point over the
/// distance between the cells. A ray from a point of the cell that climbs more steeply than the bound meets nothing:
/// near by the surface falls behind it everywhere, and what is farther away is not high enough.
class Horizon {
 public:
  explicit Horizon(const Membrane& membrane);

  /// Height over distance, at least kFloor; infinite where the surface folds over, and beside the grid.
  double steepness(double x, double y) const;

  static constexpr double kFloor = 0.5;  // lower lights are always traced; keeps the search short

 private:
  int cell(double at, double low, int count) const;

  double low_x_, low_y_, width_;
  int columns_, rows_;
  std::vector<double> bound_;
};

}  // namespace tacipc
