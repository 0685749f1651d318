#include "stages/object/emboss/picture_relief.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "common/base/error.h"

namespace tacipc {
namespace {

/// Height of each pixel (x, y).
using Raster = Eigen::MatrixXd;

std::vector<double> gaussian_weights(double sigma_px, int radius) {
  std::vector<double> weights(2 * radius + 1);
  double sum = 0.0;
  for (int i = -radius; i <= radius; ++i) sum += weights[i + radius] = std::exp(-0.5 * (i / sigma_px) * (i / sigma_px));
  for (double& weight : weights) weight /= sum;
  return weights;
}

/// One pass along x with transposed result: two passes blur the plane.
Raster blurred_transposed(const Raster& in, const std::vector<double>& weights) {
  const int radius = static_cast<int>(weights.size() / 2);
  const int width = static_cast<int>(in.rows()), height = static_cast<int>(in.cols());
  Raster out(height, width);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      double sum = 0.0;
      for (int i = std::max(-radius, -x); i <= std::min(radius, width - 1 - x); ++i)
        sum += weights[i + radius] * in(x + i, y);
      out(y, x) = sum;
    }
  }
  return out;
}

}  // namespace

Height picture_height(const ByteImage& grey, const PictureRelief& relief, const std::string& name) {
  const auto [low, high] = std::ranges::minmax_element(grey.pixels);
  if (*low == *high) throw DataError("{}: every pixel has the grey {}, so there is no relief", name, int{*low});

  const double pixel_m = relief.width_m / grey.width;
  const double sigma_px = relief.wall_m / std::sqrt(2.0 * std::numbers::pi) / pixel_m;
  const int radius = static_cast<int>(std::ceil(4.0 * sigma_px));
  const int border = radius + 1;  // border of zeros around the picture, so that its edge is also a wall
  Raster raster = Raster::Zero(grey.width + 2 * border, grey.height + 2 * border);
  for (int y = 0; y < grey.height; ++y) {
    for (int x = 0; x < grey.width; ++x) {
      const double value = grey.at(x, y, 0) / 255.0;
      raster(x + border, y + border) = relief.dark_is_high ? 1.0 - value : value;
    }
  }
  const std::vector<double> weights = gaussian_weights(sigma_px, radius);
  raster = blurred_transposed(blurred_transposed(raster, weights), weights);

  const auto shared = std::make_shared<const Raster>(std::move(raster));
  return [shared, pixel_m](const Vector2& p) {
    const Raster& at = *shared;
    const auto right = static_cast<double>(at.rows() - 1), bottom = static_cast<double>(at.cols() - 1);
    const double x = p.x() / pixel_m + 0.5 * right, y = 0.5 * bottom - p.y() / pixel_m;
    const double column = std::floor(x), row = std::floor(y);
    if (column < 0 || row < 0 || column >= right || row >= bottom) return 0.0;
    const int i = static_cast<int>(column), j = static_cast<int>(row);
    const double low_row = std::lerp(at(i, j), at(i + 1, j), x - column);
    const double high_row = std::lerp(at(i, j + 1), at(i + 1, j + 1), x - column);
    return std::clamp(std::lerp(low_row, high_row, y - row), 0.0, 1.0);
  };
}

}  // namespace tacipc
