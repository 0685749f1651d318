#include "common/image/axis.h"

#include <fmt/core.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tacipc {
namespace {

/// Tolerance within which a bound counts as on a tick.
constexpr double kSlack = 1e-9;

}  // namespace

int Axis::num_ticks() const { return static_cast<int>(std::floor((high - low) / step + 1e-6)) + 1; }

std::string Axis::tick_text(int i) const {
  // Rounded first, so that a sum that misses zero by its last bit is not shown as -0.0.
  const double value = std::abs(tick(i)) < kSlack * step ? 0.0 : tick(i);
  return fmt::format("{:.{}f}", value, decimals);
}

Axis round_axis(double low, double high, int max_ticks) {
  assert(low <= high && max_ticks >= 3);
  if (low == high) high = low + (low == 0.0 ? 1.0 : std::abs(low));
  for (int power = static_cast<int>(std::floor(std::log10((high - low) / max_ticks)));; ++power) {
    for (const int digit : {1, 2, 5}) {
      const double step = digit * std::pow(10.0, power);
      const double first = std::floor(low / step + kSlack), last = std::ceil(high / step - kSlack);
      if (last - first + 1 > max_ticks) continue;
      return {.low = first * step, .high = last * step, .step = step, .decimals = std::max(0, -power)};
    }
  }
}

Axis decade_axis(double low, double high, int max_ticks) {
  assert(0 < low && low <= high && max_ticks >= 3);
  constexpr double kMaxDecades = 12;
  const double last = std::ceil(std::log10(high) - kSlack);
  const double first = std::clamp(std::floor(std::log10(low) + kSlack), last - kMaxDecades, last - 1);
  const double step = std::ceil((last - first) / (max_ticks - 1));
  return {.low = last - step * std::ceil((last - first) / step), .high = last, .step = step, .decimals = 0};
}

std::vector<double> ticks_inside(double low, double high) {
  assert(low < high);
  const double rough = (high - low) / 5.0;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10.0 * power;
  for (const double factor : {5.0, 2.0, 1.0})
    if (factor * power >= rough) step = factor * power;
  std::vector<double> ticks;
  const double first = std::ceil(low / step - kSlack);
  for (int i = 0; (first + i) * step <= high + kSlack * step; ++i) ticks.push_back((first + i) * step + 0.0);
  return ticks;
}

std::vector<double> decade_ticks_inside(double low, double high) {
  constexpr std::size_t kMost = 8;
  std::vector<double> ticks, decades;
  for (int decade = static_cast<int>(std::floor(low)); decade <= high; ++decade) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double tick = decade + std::log10(factor);
      if (tick < low - kSlack || tick > high + kSlack) continue;
      ticks.push_back(tick);
      if (factor == 1.0) decades.push_back(tick);
    }
  }
  return ticks.size() > kMost ? decades : ticks;
}

double round_below(double value) {
  assert(value > 0);
  const double power = std::pow(10.0, std::floor(std::log10(value) + kSlack));
  for (const double digit : {5.0, 2.0}) {
    if (digit * power <= value * (1 + kSlack)) return digit * power;
  }
  return power;
}

double Scale::at(double axis_value) const {
  return low_at + (axis_value - axis.low) / (axis.high - axis.low) * (high_at - low_at);
}

std::optional<double> Scale::place(std::optional<double> value) const {
  if (!value || !std::isfinite(*value) || (logarithmic && !(*value > 0))) return std::nullopt;
  return at(logarithmic ? std::max(std::log10(*value), axis.low) : *value);
}

}  // namespace tacipc
