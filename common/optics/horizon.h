// Finds rays that cannot meet the membrane, because it is too flat there to shadow itself.
#pragma once

#include <vector>

#include "common/optics/membrane.h"

namespace tacipc {

/// Bounds, on a grid over the membrane seen along z, how steeply anything rises around a cell towards the lights.
/// Within the cell and its eight neighbours the bound is the slope of the steepest triangle; farther away, the highest
/// point over the distance between the cells. A ray from a point of the cell that is steeper than the bound meets
/// nothing: nearby the surface falls behind it, and farther away nothing is high enough.
class Horizon {
 public:
  explicit Horizon(const Membrane& membrane);

  /// Returns the bound, height over distance, at least kFloor; infinite where the surface folds over, and outside the
  /// grid.
  double steepness(double x, double y) const;

  static constexpr double kFloor = 0.5;  // lower lights are always traced, which keeps the search short

 private:
  int cell(double at, double low, int count) const;

  double low_x_, low_y_, width_;
  int columns_, rows_;
  std::vector<double> bound_;
};

}  // namespace tacipc
