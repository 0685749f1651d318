#include "stages/report/drawing.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "stages/report/html.h"

namespace tacipc {

std::optional<double> Scale::place(std::optional<double> value) const {
  if (!value || !std::isfinite(*value) || (logarithmic && !(*value > 0))) return std::nullopt;
  const double v = logarithmic ? std::max(std::log10(*value), axis.low) : *value;
  return low_at + (v - axis.low) / (axis.high - axis.low) * (high_at - low_at);
}

std::string drawing_start(const std::string& what) {
  return fmt::format("<svg class=\"curve\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n", Drawing::kWidth,
                     Drawing::kHeight, html_text(what));
}

std::string ticks_svg(const Scale& x, const Scale& left, double right_end) {
  constexpr double kLeft = Drawing::kLeft, kTop = Drawing::kTop, kBottom = Drawing::kBottom;
  std::string svg;
  for (int i = 0; i < x.axis.num_ticks(); ++i) {
    const double at = x.low_at + i * x.axis.step / (x.axis.high - x.axis.low) * (x.high_at - x.low_at);
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

}  // namespace tacipc
