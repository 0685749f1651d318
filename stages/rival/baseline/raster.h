// Scalar maps in double precision: heights, depths, kernels.
#pragma once

#include <vector>

namespace tacipc {

/// Row-major numbers, row 0 on top.
struct Raster {
  int width = 0;
  int height = 0;
  std::vector<double> values;

  Raster() = default;
  Raster(int w, int h, double value = 0.0)
      : width(w), height(h), values(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), value) {}
  double& at(int x, int y) {
    return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
  double at(int x, int y) const { return const_cast<Raster*>(this)->at(x, y); }
};

}  // namespace tacipc
