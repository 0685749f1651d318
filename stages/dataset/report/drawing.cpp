#include "stages/dataset/report/drawing.h"

#include <fmt/core.h>

#include "common/format/html_text.h"

namespace tacipc {

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

}  // namespace tacipc
