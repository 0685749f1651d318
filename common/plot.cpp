#include "common/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tacipc {
namespace {

constexpr double kWidth = 480.0, kHeight = 320.0, kLeft = 62.0, kRight = 22.0, kTop = 28.0, kBottom = 44.0;
constexpr double kLine = 14.0;  // of the labels of curves, below the plot
constexpr std::array<const char*, 8> kColors{"#1f5fa8", "#c2571a", "#3a8a4a", "#7a4fa0",
                                             "#b0306a", "#7d6608", "#4d9aa6", "#55555f"};

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<') {
      out += "&lt;";
    } else if (c == '&') {
      out += "&amp;";
    } else {
      out += c;
    }
  }
  return out;
}

struct Axis {
  double low = 0.0, high = 1.0;
  double position(double value) const { return (value - low) / (high - low); }
};

Axis cover(const std::vector<double>& values, bool with_zero) {
  Axis axis{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
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

}  // namespace

std::vector<double> round_ticks(double low, double high) {
  const double rough = (high - low) / 5.0;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10.0 * power;
  for (const double factor : {5.0, 2.0, 1.0})
    if (factor * power >= rough) step = factor * power;
  std::vector<double> ticks;
  const double first = std::ceil(low / step - 1e-9);
  for (int i = 0; (first + i) * step <= high + 1e-9 * step; ++i) ticks.push_back((first + i) * step + 0.0);
  return ticks;
}

std::vector<double> decade_ticks(double low, double high) {
  constexpr std::size_t kMost = 8;
  std::vector<double> ticks, decades;
  for (int decade = static_cast<int>(std::floor(low)); decade <= high; ++decade) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double tick = decade + std::log10(factor);
      if (tick < low - 1e-9 || tick > high + 1e-9) continue;
      ticks.push_back(tick);
      if (factor == 1.0) decades.push_back(tick);
    }
  }
  return ticks.size() > kMost ? decades : ticks;
}

std::string to_svg(const Plot& plot) {
  const auto shown = [&](double v) { return plot.logarithmic ? std::log10(v) : v; };
  std::vector<double> xs, ys;
  for (const PlotCurve& curve : plot.curves) {
    for (const auto& p : curve.points) {
      if (plot.logarithmic && !(p.minCoeff() > 0.0)) continue;
      xs.push_back(shown(p.x()));
      ys.push_back(shown(p.y()));
    }
  }
  const Axis x = cover(xs, !plot.logarithmic), y = cover(ys, !plot.logarithmic);
  const auto px = [&](double v) { return kLeft + x.position(v) * (kWidth - kLeft - kRight); };
  const auto py = [&](double v) { return kHeight - kBottom - y.position(v) * (kHeight - kTop - kBottom); };
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:g} {1:g}\" width=\"{0:g}\" height=\"{1:g}\" "
      "font-family=\"sans-serif\" font-size=\"11\">\n<rect width=\"{0:g}\" height=\"{1:g}\" fill=\"white\"/>\n",
      kWidth, kHeight + kLine * static_cast<double>(plot.curves.size()));
  const auto label = [&](double tick) {
    return plot.logarithmic ? fmt::format("{:.6g}", std::pow(10.0, tick)) : fmt::format("{:.4g}", tick);
  };
  const auto ticks = [&](const Axis& axis) {
    return plot.logarithmic ? decade_ticks(axis.low, axis.high) : round_ticks(axis.low, axis.high);
  };
  for (const double tick : ticks(x)) {
    out += fmt::format(
        "<path d=\"M{0:.1f} {1:.1f}V{2:.1f}\" stroke=\"#ddd\"/><text x=\"{0:.1f}\" y=\"{3:.1f}\" "
        "text-anchor=\"middle\">{4}</text>\n",
        px(tick), kTop, kHeight - kBottom, kHeight - kBottom + 15, label(tick));
  }
  for (const double tick : ticks(y)) {
    out += fmt::format(
        "<path d=\"M{0:.1f} {1:.1f}H{2:.1f}\" stroke=\"#ddd\"/><text x=\"{3:.1f}\" y=\"{4:.1f}\" "
        "text-anchor=\"end\">{5}</text>\n",
        kLeft, py(tick), kWidth - kRight, kLeft - 5, py(tick) + 4, label(tick));
  }
  out += fmt::format("<path d=\"M{0:.1f} {1:.1f}V{2:.1f}H{3:.1f}\" fill=\"none\" stroke=\"#444\"/>\n", kLeft, kTop,
                     kHeight - kBottom, kWidth - kRight);
  for (std::size_t i = 0; i < plot.curves.size(); ++i) {
    const PlotCurve& curve = plot.curves[i];
    const char* color = kColors[i % kColors.size()];
    std::string path;
    for (const auto& p : curve.points) {
      if (plot.logarithmic && !(p.minCoeff() > 0.0)) continue;
      const double a = px(shown(p.x())), b = py(shown(p.y()));
      if (curve.dots || curve.marks)
        out += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"none\" stroke=\"{}\"/>\n", a, b, color);
      if (!curve.dots) path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", a, b);
    }
    if (!path.empty())
      out += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"/>\n", path, color);
    out += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" fill=\"{}\">{}</text>\n", kLeft,
                       kHeight + kLine * (static_cast<double>(i) + 0.5), color, escaped(curve.label));
  }
  out += fmt::format("<text x=\"{:.1f}\" y=\"16\" text-anchor=\"middle\" font-size=\"12\">{}</text>\n", kWidth / 2,
                     escaped(plot.title));
  out += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n", (kLeft + kWidth) / 2,
                     kHeight - 8, escaped(plot.x_label));
  out += fmt::format("<text transform=\"translate(13 {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n</svg>\n",
                     (kTop + kHeight - kBottom) / 2, escaped(plot.y_label));
  return out;
}

}  // namespace tacipc
