#include "common/benchmark/depth_error.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

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
            .mse_norm = square / n / (deepest * deepest),
            .slope_ratio = reference_slopes > 0.0 ? std::sqrt(slopes / reference_slopes) : kUndefined,
            .iou = iou};
  }
};

/// Returns the squared slope at a pixel, m² per pixel², from neighbours that exist and are not NaN.
double squared_slope(const FloatImage& map, int x, int y) {
  double sum = 0.0;
  for (const auto& [u, v] : {std::pair{x + 1, y}, std::pair{x, y + 1}}) {
    if (u >= map.width || v >= map.height) continue;
    const double step = double{map.at(u, v, 0)} - double{map.at(x, y, 0)};
    if (std::isfinite(step)) sum += step * step;
  }
  return sum;
}

/// Returns the pixels of a mask and those at most `reach` columns and rows away from it.
std::vector<bool> grown(const std::vector<bool>& mask, int width, int height, int reach) {
  const auto along = [reach](const std::vector<bool>& in, int lines, int line_step, int length, int step) {
    std::vector<bool> out(in.size(), false);
    for (int line = 0; line < lines; ++line) {
      int last = -reach - 1;  // last pixel of the mask, in forward, then backward direction
      const auto at = [&](int k) { return static_cast<std::size_t>(line * line_step + k * step); };
      for (int k = 0; k < length; ++k) {
        if (in[at(k)]) last = k;
        if (k - last <= reach) out[at(k)] = true;
      }
      last = length + reach;
      for (int k = length - 1; k >= 0; --k) {
        if (in[at(k)]) last = k;
        if (last - k <= reach) out[at(k)] = true;
      }
    }
    return out;
  };
  return along(along(mask, height, width, width, 1), width, 1, height, width);
}

}  // namespace

MetricsRow row_of(const std::string& name, const char* region, const DepthError& error) {
  return {.name = name,
          .region = region,
          .values = {{"pixels", static_cast<double>(error.pixels)},
                     {"mae_mm", 1e3 * error.mae_m},
                     {"mse_mm2", 1e6 * error.mse_m2},
                     {"max_mm", 1e3 * error.max_m},
                     {"mae_norm", error.mae_norm},
                     {"mse_norm", error.mse_norm},
                     {"slope_ratio", error.slope_ratio},
                     {"iou", error.iou}}};
}

DepthErrors depth_errors(const FloatImage& map, const FloatImage& reference, const FloatImage& rest,
                         const DepthRegions& regions, const FloatImage* surface) {
  assert(map.pixels.size() == reference.pixels.size() && rest.pixels.size() == map.pixels.size());
  assert(!surface || surface->pixels.size() == map.pixels.size());
  const std::size_t pixels = map.pixels.size();
  std::vector<bool> is_pressed(pixels), in_contact(pixels, false);
  for (std::size_t i = 0; i < pixels; ++i) {
    const double at_rest = rest.pixels[i], known = reference.pixels[i];
    is_pressed[i] = at_rest - known > regions.pressed_m;
    if (surface)
      in_contact[i] = at_rest - double{surface->pixels[i]} > regions.pressed_m &&
                      std::abs(double{surface->pixels[i]} - known) <= regions.contact_m;
  }
  const std::vector<bool>& inner = surface ? in_contact : is_pressed;
  const std::vector<bool> near = grown(inner, map.width, map.height, regions.beside_px);
  Sums full, pressed, contact, beside;
  std::size_t both = 0, either = 0;
  double deepest = 0.0;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const double a = map.at(x, y, 0), b = reference.at(x, y, 0), r = rest.at(x, y, 0);
      if (!std::isfinite(a) || !std::isfinite(b) || !std::isfinite(r)) continue;
      const auto pixel = static_cast<std::size_t>(y) * map.width + x;
      const bool seems_pressed = r - a > regions.pressed_m;
      both += is_pressed[pixel] && seems_pressed;
      either += is_pressed[pixel] || seems_pressed;
      deepest = std::max(deepest, r - b);
      const double error = std::abs(a - b);
      const double slope = squared_slope(map, x, y), reference_slope = squared_slope(reference, x, y);
      for (const auto& [sums, counts] :
           {std::pair{&full, true}, std::pair{&pressed, bool{is_pressed[pixel]}},
            std::pair{&contact, bool{in_contact[pixel]}}, std::pair{&beside, near[pixel] && !inner[pixel]}}) {
        if (!counts) continue;
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
  if (pressed.pixels == 0)
    throw DataError("the reference is nowhere pressed deeper than {:.4g} mm", 1e3 * regions.pressed_m);
  if (surface && contact.pixels == 0)
    throw DataError("the reference is nowhere within {:.4g} mm of the object's surface", 1e3 * regions.contact_m);
  const double iou = static_cast<double>(both) / static_cast<double>(either);
  DepthErrors errors{.full = full.over(deepest, iou), .pressed = pressed.over(deepest, iou)};
  if (surface) errors.contact = contact.over(deepest, iou);
  if (beside.pixels > 0) errors.beside = beside.over(deepest, iou);
  return errors;
}

}  // namespace tacipc
