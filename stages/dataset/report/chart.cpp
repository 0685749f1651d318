#include "stages/dataset/report/chart.h"

#include <fmt/core.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "common/format/html_text.h"
#include "stages/dataset/report/html.h"

namespace tacipc {
namespace {

constexpr double kBandTop = 6;

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
  const Axis axis = logarithmic ? decade_axis(low.value_or(1.0), high.value_or(1.0), Drawing::kMaxTicks)
                                : round_axis(low.value_or(0.0), high.value_or(0.0), Drawing::kMaxTicks);
  return {axis, Drawing::kBottom, Drawing::kTop, logarithmic};
}

std::string right_ticks_svg(const Scale& right, double right_end) {
  std::string svg = fmt::format("<path class=\"axis\" d=\"M{} {}V{}\"/>\n", right_end, Drawing::kTop, Drawing::kBottom);
  for (const Tick& tick : ticks_of(right))
    svg += fmt::format("<text class=\"right-tick\" x=\"{}\" y=\"{:.2f}\">{}</text>\n", right_end + 7, tick.at + 4,
                       tick.label);
  return svg;
}

/// The name stands along the interval if it fits, otherwise vertically, otherwise only as a tooltip.
std::string band_svg(const Band& band, const Scale& x, bool dark) {
  constexpr double kLetter = 6.5, kLine = 13;
  const double from = x.place(band.from).value(), to = x.place(band.to).value();
  const double middle = 0.5 * (from + to), width = to - from;
  std::string svg = fmt::format(
      "<rect class=\"band {}\" x=\"{:.2f}\" y=\"{}\" width=\"{:.2f}\" height=\"{}\"><title>{}</title></rect>\n",
      dark ? "dark" : "light", from, kBandTop, width, Drawing::kBottom - kBandTop, html_text(band.name));
  if (width >= kLetter * static_cast<double>(band.name.size())) {
    svg += fmt::format("<text class=\"band-name\" x=\"{:.2f}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n", middle,
                       kBandTop + kLine, html_text(band.name));
  } else if (width >= kLine) {
    svg += upright_text("band-name", middle + 4, Drawing::kTop + 4, "end", band.name);
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
  return fmt::format("<g class=\"color-{}{}\">\n{}{}</g>\n", color, curve.broad ? " broad" : "", lines, marks);
}

}  // namespace

const AxesLook kPageAxes{
    .grid = "class=\"grid\"", .axis = "class=\"axis\"", .x_tick = "class=\"x-tick\"", .y_tick = "class=\"y-tick\""};

std::string drawing_start(const std::string& what) {
  return fmt::format("<svg class=\"curve\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n", Drawing::kWidth,
                     Drawing::kHeight, html_text(what));
}

std::string ticks_svg(const Scale& x, const Scale& left, double right_end) {
  const PlotArea area{.left = Drawing::kLeft, .right = right_end, .top = Drawing::kTop, .bottom = Drawing::kBottom};
  return x_ticks_svg(ticks_of(x), area, kPageAxes) + y_ticks_svg(ticks_of(left), area, kPageAxes) +
         axes_svg(area, kPageAxes);
}

std::string upright_text(const char* kind, double x, double y, const char* anchor, const std::string& words) {
  return fmt::format(
      "<text class=\"{}\" transform=\"translate({:.1f} {:.1f}) rotate(-90)\" text-anchor=\"{}\">{}</text>\n", kind, x,
      y, anchor, html_text(words));
}

std::string labels_svg(const std::string& x_label, const std::string& left_label, double right_end) {
  return fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n", 0.5 * (Drawing::kLeft + right_end),
                     Drawing::kBottom + 40, html_text(x_label)) +
         upright_text("label", 12, 0.5 * (Drawing::kTop + Drawing::kBottom), "middle", left_label);
}

std::string chart_svg(const Chart& chart) {
  assert(!chart.x.empty());
  const double right_end = chart.right.empty() ? Drawing::kRight : 338.0;
  const auto [first, last] = std::minmax_element(chart.x.begin(), chart.x.end());
  Axis across = round_axis(std::min(0.0, *first), std::max(0.0, *last), Drawing::kMaxTicks);
  if (chart.whole_x && across.step < 1.0)
    across = {.low = std::floor(across.low), .high = 0.0, .step = 1.0, .decimals = 0};
  if (chart.whole_x) across.high = std::max(*last, across.low + 1.0);
  const Scale x{across, Drawing::kLeft, right_end};
  const Scale left = value_scale(chart.left, chart.logarithmic, chart.limit);

  std::string svg = drawing_start(chart.what);
  bool dark = true;
  for (const Band& band : chart.bands) svg += band_svg(band, x, std::exchange(dark, !dark));
  svg += ticks_svg(x, left, right_end);
  svg += labels_svg(chart.x_label, chart.left_label, right_end);
  const double middle = 0.5 * (Drawing::kTop + Drawing::kBottom);
  for (const Rule& rule : chart.places) {
    const double at = x.place(rule.at).value();
    svg += fmt::format("<path class=\"rule\" d=\"M{:.2f} {}V{}\"/>", at, Drawing::kTop, Drawing::kBottom);
    svg += upright_text("rule-name", at - 4, Drawing::kBottom - 6, "start", rule.name);
  }
  if (chart.limit) {
    const double at = left.place(chart.limit->at).value();
    svg += fmt::format("<path class=\"rule\" d=\"M{} {:.2f}H{}\"/>", Drawing::kLeft, at, right_end);
    svg += fmt::format("<text class=\"rule-name\" x=\"{}\" y=\"{:.2f}\" text-anchor=\"end\">{}</text>\n", right_end - 4,
                       at + (at < Drawing::kTop + 18 ? 14 : -5), html_text(chart.limit->name));
  }
  int color = 0;
  for (const Curve& curve : chart.left) svg += curve_svg(curve, chart.x, x, left, ++color);
  if (!chart.right.empty()) {
    const Scale right = value_scale(chart.right, false, std::nullopt);
    svg += right_ticks_svg(right, right_end);
    svg += upright_text("label", Drawing::kWidth - 4, middle, "middle", chart.right_label);
    for (const Curve& curve : chart.right) svg += curve_svg(curve, chart.x, x, right, ++color);
  }
  return svg + "</svg>\n";
}

std::string figure(const Chart& chart, const std::string& caption) { return figure(chart_svg(chart), caption); }

std::string curve_key(int color, bool broad) {
  return fmt::format("<i class=\"key color-{}{}\"></i>", color, broad ? " broad" : "");
}

}  // namespace tacipc
