#include "stages/study/metrics/depth_error.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "common/base/error.h"

namespace tacipc {
namespace {

constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();

/// Sums over the pixels of a region.
struct Sums {
  std::size_t pixels = 0;
  double absolute = 0.0, square = 0.0, largest = 0.0;
  double slopes = 0.0, reference_slopes = 0.0;

  DepthError over(double deepest, double iou) const {
    const auto n = static_cast<double>(pixels);
    return {.pixels = pixels,
            .mae_m = absolute / n,
            .mse_m2 = square / n,
            .max_m = largest,
            .mae_norm = absolute / n / deepest,
            .slope_ratio = reference_slopes > 0.0 ? std::sqrt(slopes / reference_slopes) : kUndefined,
            .iou = iou};
  }
};

/// Squared slope at a pixel, m² per pixel²: neighbours that are there and known.
double squared_slope(const FloatImage& map, int x, int y) {
  double sum = 0.0;
  for (const auto& [u, v] : {std::pair{x + 1, y}, std::pair{x, y + 1}}) {
    if (u >= map.width || v >= map.height) continue;
    const double step = double{map.at(u, v, 0)} - double{map.at(x, y, 0)};
    if (std::isfinite(step)) sum += step * step;
  }
  return sum;
}

}  // namespace

DepthErrors depth_errors(const FloatImage& map, const FloatImage& reference, const FloatImage& rest, double pressed_m) {
  assert(map.pixels.size() == reference.pixels.size() && rest.pixels.size() == map.pixels.size());
  Sums full, pressed;
  std::size_t both = 0, either = 0;
  double deepest = 0.0;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const double a = map.at(x, y, 0), b = reference.at(x, y, 0), r = rest.at(x, y, 0);
      if (!std::isfinite(a) || !std::isfinite(b) || !std::isfinite(r)) continue;
      const bool is_pressed = r - b > pressed_m, seems_pressed = r - a > pressed_m;
      both += is_pressed && seems_pressed;
      either += is_pressed || seems_pressed;
      deepest = std::max(deepest, r - b);
      const double error = std::abs(a - b);
      const double slope = squared_slope(map, x, y), reference_slope = squared_slope(reference, x, y);
      for (Sums* sums : {&full, &pressed}) {
        if (sums == &pressed && !is_pressed) continue;
        ++sums->pixels;
        sums->absolute += error;
        sums->square += error * error;
        sums->largest = std::max(sums->largest, error);
        sums->slopes += slope;
        sums->reference_slopes += reference_slope;
      }
    }
  }
  if (full.pixels == 0) throw DataError("no pixel is known in all three maps");
  if (pressed.pixels == 0) throw DataError("the reference is nowhere pressed deeper than {:.4g} mm", 1e3 * pressed_m);
  const double iou = static_cast<double>(both) / static_cast<double>(either);
  return {.full = full.over(deepest, iou), .pressed = pressed.over(deepest, iou)};
}

}  // namespace tacipc
