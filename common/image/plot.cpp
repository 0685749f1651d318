#include "common/image/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "common/format/html_text.h"
#include "common/image/svg.h"

namespace tacipc {
namespace {

constexpr double kWidth = 480.0, kHeight = 320.0;
constexpr PlotArea kArea{.left = 62.0, .right = 458.0, .top = 28.0, .bottom = 276.0};
constexpr double kLine = 14.0;  // height of a legend line below the plot
constexpr std::array<const char*, 8> kColors{"#1f5fa8", "#c2571a", "#3a8a4a", "#7a4fa0",
                                             "#b0306a", "#7d6608", "#4d9aa6", "#55555f"};

Axis cover(const std::vector<double>& values, bool with_zero) {
  Axis axis{.low = std::numeric_limits<double>::infinity(), .high = -std::numeric_limits<double>::infinity()};
  for (const double v : values) {
    axis.low = std::min(axis.low, v);
    axis.high = std::max(axis.high, v);
  }
  if (values.empty()) return {};
  if (with_zero) axis.low = std::min(axis.low, 0.0);
  if (!(axis.high > axis.low)) axis.high = axis.low + std::max(1e-12, std::abs(axis.low));
  const double room = 0.04 * (axis.high - axis.low);
  axis.high += room;
  if (!with_zero) axis.low -= room;
  return axis;
}

std::vector<Tick> plot_ticks(const Scale& scale) {
  const double low = scale.axis.low, high = scale.axis.high;
  std::vector<Tick> ticks;
  for (const double tick : scale.logarithmic ? decade_ticks_inside(low, high) : ticks_inside(low, high))
    ticks.push_back({scale.at(tick),
                     scale.logarithmic ? fmt::format("{:.6g}", std::pow(10.0, tick)) : fmt::format("{:.4g}", tick)});
  return ticks;
}

}  // namespace

std::string to_svg(const Plot& plot) {
  const bool logarithmic = plot.logarithmic;
  std::vector<double> xs, ys;
  for (const PlotCurve& curve : plot.curves) {
    for (const auto& p : curve.points) {
      if (logarithmic && !(p.minCoeff() > 0.0)) continue;
      xs.push_back(logarithmic ? std::log10(p.x()) : p.x());
      ys.push_back(logarithmic ? std::log10(p.y()) : p.y());
    }
  }
  const Scale x{cover(xs, plot.zero_in_x && !logarithmic), kArea.left, kArea.right, logarithmic};
  const Scale y{cover(ys, !logarithmic), kArea.bottom, kArea.top, logarithmic};
  std::string out = svg_file_start(kWidth, kHeight + kLine * static_cast<double>(plot.curves.size()), 11);
  out += x_ticks_svg(plot_ticks(x), kArea, file_axes()) + y_ticks_svg(plot_ticks(y), kArea, file_axes());
  out += axes_svg(kArea, file_axes());
  for (std::size_t i = 0; i < plot.curves.size(); ++i) {
    const PlotCurve& curve = plot.curves[i];
    const char* color = kColors[i % kColors.size()];
    std::string path;
    for (const auto& p : curve.points) {
      const auto column = x.place(p.x()), row = y.place(p.y());
      if (!column || !row) continue;
      if (curve.dots || curve.marks)
        out += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"none\" stroke=\"{}\"/>\n", *column, *row,
                           color);
      if (!curve.dots) path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", *column, *row);
    }
    if (!path.empty())
      out += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"/>\n", path, color);
    out += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" fill=\"{}\">{}</text>\n", kArea.left,
                       kHeight + kLine * (static_cast<double>(i) + 0.5), color, html_text(curve.label));
  }
  out += fmt::format("<text x=\"{:.1f}\" y=\"16\" text-anchor=\"middle\" font-size=\"12\">{}</text>\n", kWidth / 2,
                     html_text(plot.title));
  out += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n", (kArea.left + kWidth) / 2,
                     kHeight - 8, html_text(plot.x_label));
  out += fmt::format("<text transform=\"translate(13 {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n</svg>\n",
                     (kArea.top + kArea.bottom) / 2, html_text(plot.y_label));
  return out;
}

}  // namespace tacipc
