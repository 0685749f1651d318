#include "stages/dataset/report/dataset/coverage_svg.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "common/format/html_text.h"
#include "stages/dataset/report/chart.h"
#include "stages/dataset/report/html.h"

namespace tacipc {
namespace {

constexpr double kLeft = Drawing::kLeft, kRight = Drawing::kRight, kTop = Drawing::kTop, kBottom = Drawing::kBottom;

/// Axis with ticks at whole numbers, for counts.
Axis count_axis(std::size_t largest) {
  Axis axis = round_axis(0.0, static_cast<double>(std::max<std::size_t>(largest, 1)), Drawing::kMaxTicks);
  if (axis.step < 1.0) axis = {.low = 0.0, .high = std::ceil(axis.high), .step = 1.0, .decimals = 0};
  return axis;
}

/// Axis with few ticks over all bins, at edges of bins.
Axis tick_axis(const Axis& bins) {
  Axis axis = bins;
  const int steps = bins.num_ticks() - 1;
  if (steps < Drawing::kMaxTicks) return axis;
  const int stride = (steps + Drawing::kMaxTicks - 2) / (Drawing::kMaxTicks - 1);
  axis.step *= stride;
  return axis;
}

}  // namespace

std::string histogram_svg(const Histogram& histogram, const std::vector<std::string>& groups, const std::string& what,
                          const std::string& x_label) {
  const Scale x{tick_axis(histogram.bins), kLeft, kRight}, y{count_axis(histogram.largest()), kBottom, kTop};
  std::string svg = drawing_start(what) + ticks_svg(x, y, kRight) + labels_svg(x_label, "samples", kRight);
  std::vector<std::size_t> below(static_cast<std::size_t>(histogram.num_bins()), 0);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    svg += fmt::format("<g class=\"bars color-{}\">\n", g + 1);
    for (int bin = 0; bin < histogram.num_bins(); ++bin) {
      const auto i = static_cast<std::size_t>(bin);
      const std::size_t count = histogram.counts[g][i];
      if (count == 0) continue;
      const double from = x.place(histogram.bins.tick(bin)).value(), to = x.place(histogram.bins.tick(bin + 1)).value();
      const double low = y.place(static_cast<double>(below[i])).value();
      const double high = y.place(static_cast<double>(below[i] += count)).value();
      svg += fmt::format(
          "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\"><title>{} to {}: {} {}</title></rect>\n",
          from + 0.5, high, std::max(0.5, to - from - 1.0), low - high, histogram.bins.tick_text(bin),
          histogram.bins.tick_text(bin + 1), count, html_text(groups[g]));
    }
    svg += "</g>\n";
  }
  return svg + "</svg>\n";
}

std::string pair_map_svg(const PairMap& map, const std::string& what, const std::string& x_label,
                         const std::string& y_label) {
  const Scale x{map.x, kLeft, kRight}, y{map.y, kBottom, kTop};
  std::string svg = drawing_start(what) + ticks_svg(x, y, kRight) + labels_svg(x_label, y_label, kRight);
  const double width = (kRight - kLeft) / map.columns, height = (kBottom - kTop) / map.rows;
  const double full = std::log1p(static_cast<double>(map.largest()));
  svg += "<g class=\"cells color-1\">\n";
  for (int row = 0; row < map.rows; ++row) {
    for (int column = 0; column < map.columns; ++column) {
      const std::size_t count = map.counts[static_cast<std::size_t>(row) * static_cast<std::size_t>(map.columns) +
                                           static_cast<std::size_t>(column)];
      if (count == 0) continue;
      const double opacity = 0.3 + 0.7 * std::log1p(static_cast<double>(count)) / full;
      svg += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" opacity=\"{:.2f}\"/>\n",
                         kLeft + column * width, kBottom - (row + 1) * height, width, height, opacity);
    }
  }
  return svg + "</g>\n</svg>\n";
}

std::string spreads_svg(const std::vector<std::pair<std::string, Spread>>& rows, const std::string& what,
                        const std::string& x_label) {
  constexpr double kNames = 120, kRow = 20, kFirst = 8;
  double low = 0.0, high = 0.0;
  for (const auto& [name, spread] : rows) {
    low = std::min(low, spread.low);
    high = std::max(high, spread.high);
  }
  const Scale x{round_axis(low, high, Drawing::kMaxTicks), kNames, kRight};
  const double bottom = kFirst + kRow * static_cast<double>(rows.size());
  std::string svg = fmt::format("<svg class=\"curve\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n",
                                Drawing::kWidth, bottom + 48, html_text(what));
  svg += x_ticks_svg(ticks_of(x), {.left = kNames, .right = kRight, .top = 0.0, .bottom = bottom}, kPageAxes);
  svg += fmt::format("<path class=\"axis\" d=\"M{} {}H{}\"/>\n", kNames, bottom, kRight);
  svg += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n", 0.5 * (kNames + kRight), bottom + 40,
                     html_text(x_label));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& [name, spread] = rows[i];
    const auto at = [&](double value) { return x.place(value).value(); };
    const double y = kFirst + kRow * (static_cast<double>(i) + 0.5);
    // Names that are too long for their column are shortened.
    constexpr std::size_t kLetters = 15;
    const std::string shown = name.size() > kLetters ? name.substr(0, kLetters - 1) + "…" : name;
    svg += fmt::format("<text x=\"{}\" y=\"{:.1f}\" text-anchor=\"end\">{}<title>{}</title></text>\n", kNames - 8,
                       y + 4.5, html_text(shown), html_text(name));
    svg += fmt::format(
        "<g class=\"spread\"><title>{}: {} samples, {} to {}, median {}</title><path d=\"M{:.2f} {:.1f}H{:.2f}\"/>"
        "<rect x=\"{:.2f}\" y=\"{:.1f}\" width=\"{:.2f}\" height=\"10\" rx=\"2\"/>"
        "<path class=\"median\" d=\"M{:.2f} {:.1f}v12\"/></g>\n",
        html_text(name), spread.count, number_text(spread.low), number_text(spread.high), number_text(spread.median),
        at(spread.low), y, at(spread.high), at(spread.p5), y - 5, std::max(1.0, at(spread.p95) - at(spread.p5)),
        at(spread.median), y - 6);
  }
  return svg + "</svg>\n";
}

}  // namespace tacipc
