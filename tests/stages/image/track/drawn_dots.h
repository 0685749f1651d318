// Photographs of dots whose centres are known, drawn by exact coverage.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <functional>
#include <vector>

#include "common/image/image.h"

namespace tacipc {

/// Dots of `radius_px` and `left` of the light around them; light(x, y) in [0, 1] without dots. Each pixel is the mean
/// over 16 × 16 points, coded by the curve of sRGB, rounded.
inline ByteImage drawn_dots(int width, int height, const std::vector<Eigen::Vector2d>& centers, double radius_px,
                            double left, const std::function<double(double, double)>& light) {
  constexpr int kPoints = 16;
  ByteImage image(width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      double sum = 0.0;
      for (int v = 0; v < kPoints; ++v)
        for (int u = 0; u < kPoints; ++u) {
          const Eigen::Vector2d at(x + (u + 0.5) / kPoints, y + (v + 0.5) / kPoints);
          bool covered = false;
          for (const Eigen::Vector2d& c : centers) covered = covered || (at - c).squaredNorm() <= radius_px * radius_px;
          sum += light(at.x(), at.y()) * (covered ? left : 1.0);
        }
      const double mean = sum / (kPoints * kPoints);
      const double code = mean <= 0.0031308 ? 12.92 * mean : 1.055 * std::pow(mean, 1.0 / 2.4) - 0.055;
      for (int c = 0; c < 3; ++c) image.at(x, y, c) = static_cast<std::uint8_t>(std::lround(255.0 * code));
    }
  return image;
}

/// Even light.
inline double even_light(double, double) { return 0.5; }

/// A grid of dots `pitch` apart, the first at `first`, rows one after the other.
inline std::vector<Eigen::Vector2d> dot_grid(int rows, int columns, double pitch, const Eigen::Vector2d& first) {
  std::vector<Eigen::Vector2d> centers;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) centers.push_back(first + pitch * Eigen::Vector2d(c, r));
  return centers;
}

}  // namespace tacipc
