// Scalar maps in double precision: heights, depths, kernels.
#pragma once

#include <vector>

#include "common/image/image.h"

namespace tacipc {

/// Row-major numbers, row 0 at the top.
struct Raster {
  int width = 0;
  int height = 0;
  std::vector<double> values;

  Raster() = default;
  Raster(int w, int h, double value = 0.0) : width(w), height(h), values(static_cast<std::size_t>(w) * h, value) {}
  double& at(int x, int y) { return values[static_cast<std::size_t>(y) * width + x]; }
  double at(int x, int y) const { return const_cast<Raster*>(this)->at(x, y); }
};

/// Copy as an image of one channel, in single precision.
inline FloatImage to_image(const Raster& raster) {
  FloatImage image(raster.width, raster.height, 1);
  for (std::size_t i = 0; i < raster.values.size(); ++i) image.pixels[i] = static_cast<float>(raster.values[i]);
  return image;
}

}  // namespace tacipc
