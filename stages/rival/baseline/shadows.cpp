#include "stages/rival/baseline/shadows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "common/sensor/light_field.h"
#include "stages/rival/baseline/kernel.h"

namespace tacipc {
namespace {

constexpr double kStepPx = 1.25;
constexpr std::array<double, 4> kFan{-0.1, -0.05, 0.0, 0.05};  // angles, rad

struct Ray {
  int x, y;
  double direction;
};

/// Darkens along one ray of the fan.
/// \pre `list` belongs to one channel
void darken(FloatImage& change, std::size_t channel, const std::vector<double>& list, const Raster& height,
            const Ray& ray, double step_px) {
  const double dx = step_px * std::cos(ray.direction), dy = step_px * std::sin(ray.direction);
  for (std::size_t s = 1; s < list.size(); ++s) {
    const auto along = static_cast<double>(s);
    const int x = static_cast<int>(ray.x + along * dx), y = static_cast<int>(ray.y + along * dy);
    if (x < 0 || x >= change.width || y < 0 || y >= change.height) continue;
    if (!(height.at(ray.x, ray.y) > height.at(x, y))) continue;
    float& code = change.at(x, y, static_cast<int>(channel));
    code = std::min(code, static_cast<float>(list[s]));
  }
}

}  // namespace

std::vector<bool> ring_around(const std::vector<bool>& contact, int width, int height, double pixel_factor) {
  constexpr int kDilatedPx = 4;  // two dilations by two pixels
  const int reach = std::max(1, static_cast<int>(std::lround(kDilatedPx * pixel_factor)));
  const auto at = [&](int x, int y) { return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + x; };
  std::vector<bool> rows(contact.size(), false), ring(contact.size(), false);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int u = std::max(x - reach, 0); u <= std::min(x + reach, width - 1); ++u)
        if (contact[at(u, y)]) rows[at(x, y)] = true;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int v = std::max(y - reach, 0); v <= std::min(y + reach, height - 1); ++v)
        if (rows[at(x, v)] && !contact[at(x, y)]) ring[at(x, y)] = true;
  return ring;
}

void cast_shadows(FloatImage& change, const ShadowTable& table, const Raster& indentation_m,
                  const std::vector<bool>& contact, double pixel_m, double pixel_factor) {
  const Slopes slopes = slopes_of(indentation_m, pixel_m);
  const std::vector<bool> ring = ring_around(contact, change.width, change.height, pixel_factor);
  constexpr int kFirstDepth = 6;  // index of the pin's first depth, as released
  for (int y = 0; y < change.height; ++y) {
    for (int x = 0; x < change.width; ++x) {
      if (!ring[static_cast<std::size_t>(y) * static_cast<std::size_t>(change.width) + x]) continue;
      const double sx = slopes.x.at(x, y), sy = slopes.y.at(x, y);
      const double uphill = sx == 0.0 && sy == 0.0 ? 0.0 : std::atan2(sy, sx);
      const int direction =
          std::min(static_cast<int>((uphill + std::numbers::pi) / ShadowTable::kDirectionStep), table.directions - 1);
      const int depth =
          kFirstDepth +
          static_cast<int>(std::floor((indentation_m.at(x, y) - ShadowTable::kFirstDepthM) / ShadowTable::kDepthStepM));
      if (depth < 0 || depth >= table.depths) continue;
      for (int channel = 0; channel < 3; ++channel) {
        const std::vector<double> list = table.list(channel, direction, depth);
        for (const double beside : kFan)
          darken(change, static_cast<std::size_t>(channel), list, indentation_m,
                 {x, y, ShadowTable::kDirectionStep * direction + beside}, kStepPx * pixel_factor);
      }
    }
  }
  constexpr double kBlurPx = 2.0;
  constexpr int kWindowPx = 5;
  change =
      correlate_channels(gaussian_blurred(change, kBlurPx * pixel_factor), window_profile(kWindowPx, pixel_factor));
}

}  // namespace tacipc
