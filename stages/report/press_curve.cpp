#include "stages/report/press_curve.h"

#include <fmt/core.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "stages/report/html.h"

namespace tacipc {
namespace {

constexpr double kWidth = 400, kHeight = 300;
constexpr double kLeft = 62, kRight = 386, kTop = 14, kBottom = 248;
constexpr int kMaxTicks = 7;

double to_column(const Axis& axis, double value) {
  return kLeft + (value - axis.low) / (axis.high - axis.low) * (kRight - kLeft);
}
double to_row(const Axis& axis, double value) {
  return kBottom - (value - axis.low) / (axis.high - axis.low) * (kBottom - kTop);
}

std::string tick_text(const Axis& axis, int i) {
  // Rounded first, so that a sum that misses zero by its last bit is not shown as -0.0.
  const double value = std::abs(axis.tick(i)) < 1e-9 * axis.step ? 0.0 : axis.tick(i);
  return fmt::format("{:.{}f}", value, axis.decimals);
}

std::string axes_svg(const Axis& depth, const Axis& force) {
  std::string svg;
  for (int i = 0; i < depth.num_ticks(); ++i) {
    const double x = to_column(depth, depth.tick(i));
    svg += fmt::format("<line class=\"grid\" x1=\"{0:.2f}\" x2=\"{0:.2f}\" y1=\"{1}\" y2=\"{2}\"/>", x, kTop, kBottom);
    svg += fmt::format("<text class=\"x-tick\" x=\"{:.2f}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n", x,
                       kBottom + 18, tick_text(depth, i));
  }
  for (int i = 0; i < force.num_ticks(); ++i) {
    const double y = to_row(force, force.tick(i));
    svg += fmt::format("<line class=\"grid\" x1=\"{1}\" x2=\"{2}\" y1=\"{0:.2f}\" y2=\"{0:.2f}\"/>", y, kLeft, kRight);
    svg += fmt::format("<text class=\"y-tick\" x=\"{}\" y=\"{:.2f}\" text-anchor=\"end\">{}</text>\n", kLeft - 8, y + 4,
                       tick_text(force, i));
  }
  svg += fmt::format("<path class=\"axis\" d=\"M{0} {1}V{2}H{3}\"/>\n", kLeft, kTop, kBottom, kRight);
  svg += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">indentation depth (mm)</text>\n",
                     0.5 * (kLeft + kRight), kBottom + 40);
  svg += fmt::format("<text transform=\"translate(16 {}) rotate(-90)\" text-anchor=\"middle\">press force (N)</text>\n",
                     0.5 * (kTop + kBottom));
  return svg;
}

}  // namespace

int Axis::num_ticks() const { return static_cast<int>(std::lround((high - low) / step)) + 1; }

Axis round_axis(double low, double high, int max_ticks) {
  assert(low <= high && max_ticks >= 3);
  if (low == high) high = low + (low == 0.0 ? 1.0 : std::abs(low));
  // A bound that misses a tick by rounding alone still counts as being on it.
  constexpr double kSlack = 1e-9;
  for (int power = static_cast<int>(std::floor(std::log10((high - low) / max_ticks)));; ++power) {
    for (const int digit : {1, 2, 5}) {
      const double step = digit * std::pow(10.0, power);
      const double first = std::floor(low / step + kSlack), last = std::ceil(high / step - kSlack);
      if (last - first + 1 > max_ticks) continue;
      return {.low = first * step, .high = last * step, .step = step, .decimals = std::max(0, -power)};
    }
  }
}

std::string press_curve_svg(const std::vector<FrameReport>& frames) {
  assert(!frames.empty());
  double low_mm = 0.0, high_mm = 0.0, low_n = 0.0, high_n = 0.0;
  for (const FrameReport& frame : frames) {
    low_mm = std::min(low_mm, 1e3 * frame.depth_m);
    high_mm = std::max(high_mm, 1e3 * frame.depth_m);
    low_n = std::min(low_n, frame.press_force_n);
    high_n = std::max(high_n, frame.press_force_n);
  }
  const Axis depth = round_axis(low_mm, high_mm, kMaxTicks), force = round_axis(low_n, high_n, kMaxTicks);
  std::string line, marks;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const FrameReport& frame = frames[i];
    const double x = to_column(depth, 1e3 * frame.depth_m), y = to_row(force, frame.press_force_n);
    line += fmt::format("{}{:.2f},{:.2f}", i == 0 ? "" : " ", x, y);
    marks += fmt::format(
        "<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"4\"><title>frame {}: {} mm, {} N, {} Newton iterations</title>"
        "</circle>\n",
        x, y, i, number_text(frame.depth_m, 1e3), number_text(frame.press_force_n), frame.newton_iterations);
  }
  return fmt::format(
      "<svg class=\"curve\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"press force over indentation depth\">\n"
      "{}<polyline points=\"{}\"/>\n{}</svg>\n",
      kWidth, kHeight, axes_svg(depth, force), line, marks);
}

}  // namespace tacipc
