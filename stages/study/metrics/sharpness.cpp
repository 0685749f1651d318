#include "stages/study/metrics/sharpness.h"

#include <cassert>
#include <cmath>
#include <vector>

#include "common/image/mirrored.h"

namespace tacipc {
namespace {

struct Grey {
  int width, height;
  std::vector<double> values;

  double at(int x, int y) const { return values[static_cast<std::size_t>(y) * width + x]; }
};

Grey mean_of_channels(const ByteImage& image) {
  Grey out{image.width, image.height, {}};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      int sum = 0;
      for (int c = 0; c < image.channels; ++c) sum += image.at(x, y, c);
      out.values.push_back(static_cast<double>(sum) / image.channels);
    }
  return out;
}

std::vector<double> gaussian(double sigma) {
  const int radius = static_cast<int>(std::ceil(4.0 * sigma));
  std::vector<double> weights;
  double sum = 0.0;
  for (int i = -radius; i <= radius; ++i) {
    weights.push_back(std::exp(-0.5 * i * i / (sigma * sigma)));
    sum += weights.back();
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

Grey blurred(const Grey& image, const std::vector<double>& weights) {
  const int radius = static_cast<int>(weights.size()) / 2;
  const auto along = [&](const Grey& from, int step_x, int step_y) {
    Grey out{from.width, from.height, {}};
    for (int y = 0; y < from.height; ++y)
      for (int x = 0; x < from.width; ++x) {
        double sum = 0.0;
        for (int i = -radius; i <= radius; ++i)
          sum += weights[i + radius] *
                 from.at(mirrored(x + i * step_x, from.width), mirrored(y + i * step_y, from.height));
        out.values.push_back(sum);
      }
    return out;
  };
  return along(along(image, 1, 0), 0, 1);
}

}  // namespace

double laplacian_variance(const ByteImage& image, double sigma, const Box& box) {
  assert(box.width > 0 && box.height > 0 && box.x + box.width <= image.width && box.y + box.height <= image.height);
  const Grey smooth = blurred(mean_of_channels(image), gaussian(sigma));
  const auto at = [&](int x, int y) { return smooth.at(mirrored(x, smooth.width), mirrored(y, smooth.height)); };
  double sum = 0.0, squares = 0.0;
  for (int y = box.y; y < box.y + box.height; ++y)
    for (int x = box.x; x < box.x + box.width; ++x) {
      const double laplacian = at(x - 1, y) + at(x + 1, y) + at(x, y - 1) + at(x, y + 1) - 4.0 * at(x, y);
      sum += laplacian;
      squares += laplacian * laplacian;
    }
  const double n = static_cast<double>(box.width) * box.height, mean = sum / n;
  return squares / n - mean * mean;
}

double sharpness(const ByteImage& image, const ByteImage& reference, const Box& box) {
  assert(image.width == reference.width && image.height == reference.height);
  return laplacian_variance(image, kSharpnessSigma, box) / laplacian_variance(reference, kSharpnessSigma, box);
}

}  // namespace tacipc
