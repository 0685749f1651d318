#include "stages/study/metrics/ssim.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace tacipc {
namespace {

constexpr double kC1 = (0.01 * 255) * (0.01 * 255);
constexpr double kC2 = (0.03 * 255) * (0.03 * 255);

/// Quantities averaged over windows: a, b, a², b², ab.
using Moments = std::array<double, 5>;

/// Weighted sums along rows, at the positions where the window fits: (width − n + 1) × height.
std::vector<Moments> sums_along_rows(const ByteImage& a, const ByteImage& b, int channel,
                                     const std::vector<double>& weights) {
  const int n = static_cast<int>(weights.size()), columns = a.width - n + 1;
  std::vector<Moments> sums(static_cast<std::size_t>(columns) * a.height);
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < columns; ++x) {
      Moments& sum = sums[static_cast<std::size_t>(y) * columns + x];
      for (int i = 0; i < n; ++i) {
        const double w = weights[i], u = a.at(x + i, y, channel), v = b.at(x + i, y, channel);
        const Moments here{u, v, u * u, v * v, u * v};
        for (std::size_t m = 0; m < here.size(); ++m) sum[m] += w * here[m];
      }
    }
  }
  return sums;
}

double similarity(const Moments& mean, double covariance_factor) {
  const auto [a, b, aa, bb, ab] = mean;
  const double variances = covariance_factor * (aa - a * a + bb - b * b);
  const double covariance = covariance_factor * (ab - a * b);
  return (2 * a * b + kC1) * (2 * covariance + kC2) / ((a * a + b * b + kC1) * (variances + kC2));
}

}  // namespace

SsimWindow gaussian_window() {
  constexpr int kRadius = 5;
  constexpr double kSigma = 1.5;
  SsimWindow window;
  double sum = 0.0;
  for (int i = -kRadius; i <= kRadius; ++i) sum += std::exp(-0.5 * i * i / (kSigma * kSigma));
  for (int i = -kRadius; i <= kRadius; ++i) window.weights.push_back(std::exp(-0.5 * i * i / (kSigma * kSigma)) / sum);
  return window;
}

SsimWindow box_window() {
  constexpr int kSize = 7;
  return {.weights = std::vector<double>(kSize, 1.0 / kSize),
          .covariance_factor = double{kSize * kSize} / (kSize * kSize - 1)};
}

SsimMap ssim_map(const ByteImage& a, const ByteImage& b, int channel, const SsimWindow& window) {
  assert(a.width == b.width && a.height == b.height && a.channels == b.channels);
  assert(a.width >= window.size() && a.height >= window.size());
  SsimMap map{.width = a.width - window.size() + 1,
              .height = a.height - window.size() + 1,
              .margin = window.size() / 2,
              .values = {}};
  const std::vector<Moments> along_rows = sums_along_rows(a, b, channel, window.weights);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      Moments mean{};
      for (int i = 0; i < window.size(); ++i) {
        const Moments& row = along_rows[static_cast<std::size_t>(y + i) * static_cast<std::size_t>(map.width) +
                                        static_cast<std::size_t>(x)];
        for (std::size_t m = 0; m < mean.size(); ++m) mean[m] += window.weights[i] * row[m];
      }
      map.values.push_back(similarity(mean, window.covariance_factor));
    }
  }
  return map;
}

double ssim(const ByteImage& a, const ByteImage& b, const SsimWindow& window) {
  return ssim_in_box(a, b, window, {0, 0, a.width, a.height});
}

double ssim_in_box(const ByteImage& a, const ByteImage& b, const SsimWindow& window, const Box& box) {
  double total = 0.0;
  for (int channel = 0; channel < a.channels; ++channel) {
    const SsimMap map = ssim_map(a, b, channel, window);
    const int left = std::max(box.x - map.margin, 0), right = std::min(box.x + box.width - map.margin, map.width);
    const int top = std::max(box.y - map.margin, 0), bottom = std::min(box.y + box.height - map.margin, map.height);
    double sum = 0.0;
    for (int y = top; y < bottom; ++y)
      for (int x = left; x < right; ++x) sum += map.values[static_cast<std::size_t>(y) * map.width + x];
    const bool some = right > left && bottom > top;
    total += some ? sum / (static_cast<double>(right - left) * (bottom - top)) : std::nan("");
  }
  return total / a.channels;
}

}  // namespace tacipc
