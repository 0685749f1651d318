#include "stages/report/chart.h"

#include <fmt/core.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "stages/report/axis.h"
#include "stages/report/html.h"

namespace tacipc {
namespace {

constexpr double kWidth = 400, kHeight = 300;
constexpr double kLeft = 62, kTop = 24, kBottom = 248, kBandTop = 6;
constexpr int kMaxTicks = 7;

/// Where values come to lie on the drawing.
struct Scale {
  Axis axis;
  double low_at, high_at;  // drawing coordinates of the axis' ends
  bool logarithmic = false;

  /// Not there: cannot be drawn on a logarithmic scale.
  std::optional<double> place(std::optional<double> value) const {
    if (!value || !std::isfinite(*value) || (logarithmic && !(*value > 0))) return std::nullopt;
    const double v = logarithmic ? std::max(std::log10(*value), axis.low) : *value;
    return low_at + (v - axis.low) / (axis.high - axis.low) * (high_at - low_at);
  }
  std::string tick_text(int i) const { return (logarithmic ? "1e" : "") + axis.tick_text(i); }
};

Scale value_scale(const std::vector<Curve>& curves, bool logarithmic, const std::optional<Rule>& limit) {
  std::optional<double> low, high;
  const auto include = [&](std::optional<double> value) {
    if (!value || !std::isfinite(*value) || (logarithmic && !(*value > 0))) return;
    low = std::min(low.value_or(*value), *value);
    high = std::max(high.value_or(*value), *value);
  };
  if (!logarithmic) include(0.0);
  if (limit) include(limit->at);
  for (const Curve& curve : curves) std::for_each(curve.values.begin(), curve.values.end(), include);
  const Axis axis = logarithmic ? decade_axis(low.value_or(1.0), high.value_or(1.0), kMaxTicks)
                                : round_axis(low.value_or(0.0), high.value_or(0.0), kMaxTicks);
  return {axis, kBottom, kTop, logarithmic};
}

std::string ticks_svg(const Scale& x, const Scale& left, double right_end) {
  std::string svg;
  for (int i = 0; i < x.axis.num_ticks(); ++i) {
    const double at = x.place(x.axis.tick(i)).value();
    svg += fmt::format("<line class=\"grid\" x1=\"{0:.2f}\" x2=\"{0:.2f}\" y1=\"{1}\" y2=\"{2}\"/>", at, kTop, kBottom);
    svg += fmt::format("<text class=\"x-tick\" x=\"{:.2f}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n", at,
                       kBottom + 18, x.tick_text(i));
  }
  for (int i = 0; i < left.axis.num_ticks(); ++i) {
    const double at = kBottom - i * (kBottom - kTop) / (left.axis.num_ticks() - 1);
    svg +=
        fmt::format("<line class=\"grid\" x1=\"{1}\" x2=\"{2}\" y1=\"{0:.2f}\" y2=\"{0:.2f}\"/>", at, kLeft, right_end);
    svg += fmt::format("<text class=\"y-tick\" x=\"{}\" y=\"{:.2f}\" text-anchor=\"end\">{}</text>\n", kLeft - 8,
                       at + 4, left.tick_text(i));
  }
  svg += fmt::format("<path class=\"axis\" d=\"M{0} {1}V{2}H{3}\"/>\n", kLeft, kTop, kBottom, right_end);
  return svg;
}

std::string right_ticks_svg(const Scale& right, double right_end) {
  std::string svg = fmt::format("<path class=\"axis\" d=\"M{} {}V{}\"/>\n", right_end, kTop, kBottom);
  for (int i = 0; i < right.axis.num_ticks(); ++i) {
    svg += fmt::format("<text class=\"right-tick\" x=\"{}\" y=\"{:.2f}\">{}</text>\n", right_end + 7,
                       right.place(right.axis.tick(i)).value() + 4, right.tick_text(i));
  }
  return svg;
}

std::string upright_text(const char* kind, double x, double y, const char* anchor, const std::string& words) {
  return fmt::format(
      "<text class=\"{}\" transform=\"translate({:.1f} {:.1f}) rotate(-90)\" text-anchor=\"{}\">{}</text>\n", kind, x,
      y, anchor, html_text(words));
}

/// Named along the stretch where the name fits in, else upright, else only when pointed at.
std::string band_svg(const Band& band, const Scale& x, bool dark) {
  constexpr double kLetter = 6.5, kLine = 13;
  const double from = x.place(band.from).value(), to = x.place(band.to).value();
  const double middle = 0.5 * (from + to), width = to - from;
  std::string svg = fmt::format(
      "<rect class=\"band {}\" x=\"{:.2f}\" y=\"{}\" width=\"{:.2f}\" height=\"{}\"><title>{}</title></rect>\n",
      dark ? "dark" : "light", from, kBandTop, width, kBottom - kBandTop, html_text(band.name));
  if (width >= kLetter * static_cast<double>(band.name.size())) {
    svg += fmt::format("<text class=\"band-name\" x=\"{:.2f}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n", middle,
                       kBandTop + kLine, html_text(band.name));
  } else if (width >= kLine) {
    svg += upright_text("band-name", middle + 4, kTop + 4, "end", band.name);
  }
  return svg;
}

std::string curve_svg(const Curve& curve, const std::vector<double>& x_values, const Scale& x, const Scale& y,
                      int color) {
  std::string lines, line, marks;
  const auto end_line = [&] {
    if (!line.empty()) lines += fmt::format("<polyline points=\"{}\"/>\n", line);
    line.clear();
  };
  for (std::size_t i = 0; i < curve.values.size(); ++i) {
    const auto column = x.place(x_values[i]), row = y.place(curve.values[i]);
    if (!row) {
      end_line();
      continue;
    }
    line += fmt::format("{}{:.2f},{:.2f}", line.empty() ? "" : " ", *column, *row);
    if (!curve.titles.empty()) {
      marks += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"3.5\"><title>{}</title></circle>\n", *column, *row,
                           html_text(curve.titles[i]));
    }
  }
  end_line();
  return fmt::format("<g class=\"color-{}\">\n{}{}</g>\n", color, lines, marks);
}

}  // namespace

std::string chart_svg(const Chart& chart) {
  assert(!chart.x.empty());
  const double right_end = chart.right.empty() ? 386 : 338;
  const auto [first, last] = std::minmax_element(chart.x.begin(), chart.x.end());
  Axis across = round_axis(std::min(0.0, *first), std::max(0.0, *last), kMaxTicks);
  if (chart.whole_x && across.step < 1.0)
    across = {.low = std::floor(across.low), .high = 0.0, .step = 1.0, .decimals = 0};
  if (chart.whole_x) across.high = std::max(*last, across.low + 1.0);
  const Scale x{across, kLeft, right_end};
  const Scale left = value_scale(chart.left, chart.logarithmic, chart.limit);

  std::string svg = fmt::format("<svg class=\"curve\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n", kWidth,
                                kHeight, html_text(chart.what));
  bool dark = true;
  for (const Band& band : chart.bands) svg += band_svg(band, x, std::exchange(dark, !dark));
  svg += ticks_svg(x, left, right_end);
  svg += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n", 0.5 * (kLeft + right_end),
                     kBottom + 40, html_text(chart.x_label));
  const double middle = 0.5 * (kTop + kBottom);
  svg += upright_text("label", 16, middle, "middle", chart.left_label);
  for (const Rule& rule : chart.places) {
    const double at = x.place(rule.at).value();
    svg += fmt::format("<path class=\"rule\" d=\"M{:.2f} {}V{}\"/>", at, kTop, kBottom);
    svg += upright_text("rule-name", at - 4, kBottom - 6, "start", rule.name);
  }
  if (chart.limit) {
    const double at = left.place(chart.limit->at).value();
    svg += fmt::format("<path class=\"rule\" d=\"M{} {:.2f}H{}\"/>", kLeft, at, right_end);
    svg += fmt::format("<text class=\"rule-name\" x=\"{}\" y=\"{:.2f}\" text-anchor=\"end\">{}</text>\n", right_end - 4,
                       at + (at < kTop + 18 ? 14 : -5), html_text(chart.limit->name));
  }
  int color = 0;
  for (const Curve& curve : chart.left) svg += curve_svg(curve, chart.x, x, left, ++color);
  if (!chart.right.empty()) {
    const Scale right = value_scale(chart.right, false, std::nullopt);
    svg += right_ticks_svg(right, right_end);
    svg += upright_text("label", kWidth - 4, middle, "middle", chart.right_label);
    for (const Curve& curve : chart.right) svg += curve_svg(curve, chart.x, x, right, ++color);
  }
  return svg + "</svg>\n";
}

std::string curve_key(int color) { return fmt::format("<i class=\"key color-{}\"></i>", color); }

}  // namespace tacipc
