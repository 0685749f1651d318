#include "stages/object/emboss/texture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/base/rng.h"

namespace tacipc {
namespace {

using std::numbers::pi;

double smooth_step(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// Height of a strand's crown over its crossings: 1 if it runs over the other family, 0 if it runs under.
double crown(double along, double across_index, double phase) {
  return 0.5 + 0.5 * std::cos(pi * (along - 0.5 - across_index + phase));
}

}  // namespace

double gradient_noise(const Vector2& p, std::uint64_t seed, std::uint64_t stream) {
  const Vector2 corner(std::floor(p.x()), std::floor(p.y()));
  const Vector2 t = p - corner;
  const auto corner_value = [&](int i, int j) {
    const auto column = static_cast<std::uint32_t>(static_cast<std::int64_t>(corner.x()) + i);
    const auto row = static_cast<std::uint32_t>(static_cast<std::int64_t>(corner.y()) + j);
    const double angle = 2 * pi * random_uniform(seed, stream, (std::uint64_t{row} << 32) | column);
    return std::cos(angle) * (t.x() - i) + std::sin(angle) * (t.y() - j);
  };
  const auto blend = [](double u) { return u * u * u * (u * (6.0 * u - 15.0) + 10.0); };
  const double sx = blend(t.x()), sy = blend(t.y());
  const double low = std::lerp(corner_value(0, 0), corner_value(1, 0), sx);
  const double high = std::lerp(corner_value(0, 1), corner_value(1, 1), sx);
  return std::numbers::sqrt2 * std::lerp(low, high, sy);
}

double stone_height(const Vector2& p, double size_m, int octaves, double contrast, std::uint64_t seed) {
  double sum = 0.0, weights = 0.0, weight = 1.0, frequency = 1.0 / size_m;
  for (int octave = 0; octave < octaves; ++octave) {
    sum += weight * gradient_noise(p * frequency, seed, static_cast<std::uint64_t>(octave));
    weights += weight;
    weight *= 0.5;
    frequency *= 2.0;
  }
  return smooth_step(0.5 + 0.5 * contrast * sum / weights);
}

double weave_height(const Vector2& p, double pitch_m, double fill) {
  const Vector2 q = p / pitch_m;
  const double column = std::floor(q.x()), row = std::floor(q.y());
  const auto section = [&](double across) {
    const double t = 2.0 * across / fill;
    return std::max(0.0, 1.0 - t * t);
  };
  // Where a strand passes under, its crown is at a third of the height above the floor.
  const auto strand = [&](double across, double over) { return section(across) * (1.0 + 2.0 * over) / 3.0; };
  const double horizontal = strand(q.y() - row - 0.5, crown(q.x(), row, 0.0));
  const double vertical = strand(q.x() - column - 0.5, crown(q.y(), column, 1.0));
  return std::max(horizontal, vertical);
}

double ridges_height(const Vector2& p, double pitch_m, double bend_m, double bend_size_m, std::uint64_t seed) {
  const Vector2 bent =
      p + bend_m * Vector2(gradient_noise(p / bend_size_m, seed, 0), gradient_noise(p / bend_size_m, seed, 1));
  const double radius = std::hypot(1.2 * bent.x(), 0.8 * bent.y());
  return 0.5 + 0.5 * std::cos(2 * pi * radius / pitch_m);
}

}  // namespace tacipc
