#include "stages/rival/baseline/kernel.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "common/image/mirrored.h"

namespace tacipc {
namespace {

cv::Mat view(const Raster& raster) {
  return cv::Mat(raster.height, raster.width, CV_64F, const_cast<double*>(raster.values.data()));
}

}  // namespace

std::vector<double> folded_gaussian_profile(int size, double sigma) {
  assert(size > 0 && sigma > 0.0);
  constexpr double kTruncate = 4.0;
  const int radius = static_cast<int>(kTruncate * sigma + 0.5);
  double sum = 0.0;
  for (int i = -radius; i <= radius; ++i) sum += std::exp(-0.5 * i * i / (sigma * sigma));
  // Each tap moves the impulse to one position; positions outside the window fold back into it.
  std::vector<double> profile(size, 0.0);
  for (int to = 0; to < size; ++to)
    for (int i = -radius; i <= radius; ++i)
      if (mirrored(to + i, size) == size / 2) profile[to] += std::exp(-0.5 * i * i / (sigma * sigma)) / sum;
  return profile;
}

Raster folded_gaussian(int size, double sigma) {
  const std::vector<double> profile = folded_gaussian_profile(size, sigma);
  Raster kernel(size, size);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) kernel.at(x, y) = profile[x] * profile[y];
  return kernel;
}

Raster exponential_kernel(double factor) {
  const int reach = static_cast<int>(std::lround(6.0 * factor));
  Raster kernel(2 * reach + 1, 2 * reach + 1);
  double sum = 0.0;
  for (int y = -reach; y <= reach; ++y)
    for (int x = -reach; x <= reach; ++x)
      sum += kernel.at(x + reach, y + reach) = 201.0 / (200.0 + std::exp(std::hypot(x, y) / factor));
  for (double& weight : kernel.values) weight /= sum;
  return kernel;
}

Raster correlate(const Raster& image, const Raster& kernel, Border border, double outside) {
  Raster out(image.width, image.height);
  cv::Mat source = view(image), target = view(out);
  if (border == Border::reflect_101) {
    cv::filter2D(source, target, CV_64F, view(kernel));
    return out;
  }
  // filter2D can only pad with zeros: pad, filter, cut out.
  const int left = kernel.width / 2, top = kernel.height / 2;
  cv::Mat padded, filtered;
  cv::copyMakeBorder(source, padded, top, kernel.height - 1 - top, left, kernel.width - 1 - left, cv::BORDER_CONSTANT,
                     cv::Scalar(outside));
  cv::filter2D(padded, filtered, CV_64F, view(kernel));
  filtered(cv::Rect(left, top, image.width, image.height)).copyTo(target);
  return out;
}

std::vector<double> cut_gaussian_profile(double half, double sigma) {
  assert(sigma > 0.0);
  const int reach = static_cast<int>(std::lround(half));
  std::vector<double> profile;
  double sum = 0.0;
  for (int i = -reach; i <= reach; ++i) sum += profile.emplace_back(std::exp(-0.5 * i * i / (sigma * sigma)));
  for (double& weight : profile) weight /= sum;
  return profile;
}

std::vector<double> window_profile(int size_px, double factor) {
  const cv::Mat_<double> own = cv::getGaussianKernel(size_px, 0.0, CV_64F);
  constexpr double kSamePixels = 1e-9;
  if (std::abs(factor - 1.0) < kSamePixels) return {own.begin(), own.end()};
  constexpr int kLargestTable = 7;
  const double half = 0.5 * (size_px - 1);
  double sigma = 0.3 * (half - 1.0) + 0.8;
  if (size_px <= kLargestTable) {
    double square = 0.0;
    for (int i = 0; i < size_px; ++i) square += (i - half) * (i - half) * own(i);
    sigma = std::sqrt(square);
  }
  return cut_gaussian_profile(half * factor, sigma * factor);
}

Raster correlate_separable(const Raster& image, const std::vector<double>& profile) {
  Raster out(image.width, image.height);
  cv::Mat target = view(out);
  cv::sepFilter2D(view(image), target, CV_64F, profile, profile);
  return out;
}

Slopes slopes_of(const Raster& height_m, double pixel_m) {
  const int w = height_m.width, h = height_m.height;
  Slopes slopes{.x = Raster(w, h), .y = Raster(w, h)};
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      const int u = std::clamp(x, 1, w - 2), v = std::clamp(y, 1, h - 2);
      slopes.x.at(x, y) = (height_m.at(u + 1, v) - height_m.at(u - 1, v)) / (2.0 * pixel_m);
      slopes.y.at(x, y) = (height_m.at(u, v + 1) - height_m.at(u, v - 1)) / (2.0 * pixel_m);
    }
  }
  return slopes;
}

FloatImage correlate_channels(const FloatImage& image, const std::vector<double>& profile) {
  FloatImage out = image;
  Raster one(image.width, image.height);
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t c = 0; c < channels; ++c) {
    for (std::size_t i = 0; i < one.values.size(); ++i) one.values[i] = double{image.pixels[channels * i + c]};
    const Raster smooth = correlate_separable(one, profile);
    for (std::size_t i = 0; i < one.values.size(); ++i)
      out.pixels[channels * i + c] = static_cast<float>(smooth.values[i]);
  }
  return out;
}

void keep_to_one_thread() { cv::setNumThreads(1); }

}  // namespace tacipc
