#include "stages/object/emboss/picture_relief.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "common/base/error.h"

namespace tacipc {
namespace {

/// Row-major heights with `border` rows and columns of zeros around the picture, so that its edge is a wall too.
struct Raster {
  int width = 0;
  int height = 0;
  int border = 0;
  std::vector<double> values;

  double& at(int x, int y) { return values[static_cast<std::size_t>(y) * width + x]; }
  double at(int x, int y) const { return const_cast<Raster*>(this)->at(x, y); }
};

std::vector<double> gaussian_weights(double sigma_px, int radius) {
  std::vector<double> weights(2 * radius + 1);
  double sum = 0.0;
  for (int i = -radius; i <= radius; ++i) sum += weights[i + radius] = std::exp(-0.5 * (i / sigma_px) * (i / sigma_px));
  for (double& weight : weights) weight /= sum;
  return weights;
}

/// One pass along rows, result transposed: two passes blur the plane.
Raster blurred_rows_transposed(const Raster& in, const std::vector<double>& weights) {
  const int radius = static_cast<int>(weights.size() / 2);
  Raster out{in.height, in.width, in.border, std::vector<double>(static_cast<std::size_t>(in.width) * in.height)};
  for (int y = 0; y < in.height; ++y) {
    for (int x = 0; x < in.width; ++x) {
      double sum = 0.0;
      for (int i = std::max(-radius, -x); i <= std::min(radius, in.width - 1 - x); ++i)
        sum += weights[i + radius] * in.at(x + i, y);
      out.at(y, x) = sum;
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
  Raster raster;
  raster.border = radius + 1;
  raster.width = grey.width + 2 * raster.border;
  raster.height = grey.height + 2 * raster.border;
  raster.values.assign(static_cast<std::size_t>(raster.width) * raster.height, 0.0);
  for (int y = 0; y < grey.height; ++y) {
    for (int x = 0; x < grey.width; ++x) {
      const double value = grey.at(x, y, 0) / 255.0;
      raster.at(x + raster.border, y + raster.border) = relief.dark_is_high ? 1.0 - value : value;
    }
  }
  const std::vector<double> weights = gaussian_weights(sigma_px, radius);
  raster = blurred_rows_transposed(blurred_rows_transposed(raster, weights), weights);

  const auto shared = std::make_shared<const Raster>(std::move(raster));
  return [shared, pixel_m](const Vector2& p) {
    const double x = p.x() / pixel_m + 0.5 * (shared->width - 1), y = 0.5 * (shared->height - 1) - p.y() / pixel_m;
    const double column = std::floor(x), row = std::floor(y);
    if (column < 0 || row < 0 || column >= shared->width - 1 || row >= shared->height - 1) return 0.0;
    const int i = static_cast<int>(column), j = static_cast<int>(row);
    const double low_row = std::lerp(shared->at(i, j), shared->at(i + 1, j), x - column);
    const double high_row = std::lerp(shared->at(i, j + 1), shared->at(i + 1, j + 1), x - column);
    return std::clamp(std::lerp(low_row, high_row, y - row), 0.0, 1.0);
  };
}

}  // namespace tacipc
