#include "common/benchmark/quiver.h"

#include <fmt/format.h>

#include "common/format/html_text.h"
#include "common/image/svg.h"

namespace tacipc {

std::string quiver_svg(const MarkerField& measured, const Eigen::Matrix2Xd& simulated_px,
                       const Eigen::Vector2d& image_px, double enlarged, const std::string& title) {
  constexpr double kScale = 2.0, kFoot = 36.0;
  const double width = kScale * image_px.x(), height = kScale * image_px.y();
  const Eigen::Matrix2Xd at = kScale * measured.rest_px;
  const auto arrows = [&](const Eigen::Matrix2Xd& moved_px, const char* color) {
    return arrows_svg(at, kScale * enlarged * moved_px,
                      fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\"", color));
  };
  std::string out = svg_file_start(width, height + kFoot, 13);
  out += fmt::format("<rect width=\"{:g}\" height=\"{:g}\" fill=\"none\" stroke=\"#888\"/>\n", width, height);
  out += arrows(measured.moved_px, "#c22626") + arrows(simulated_px, "#1f5fa8");
  out += dots_svg(at, "stroke=\"#2c8a3c\" stroke-width=\"4.4\" stroke-linecap=\"round\"");
  return out + fmt::format(
                   "<text x=\"6\" y=\"{:.1f}\">{}: <tspan fill=\"#c22626\">measured</tspan>, <tspan "
                   "fill=\"#1f5fa8\">simulated</tspan>, arrows {:g} times as long; image {:g} × {:g} px</text>\n"
                   "</svg>\n",
                   height + 22.0, html_text(title), enlarged, image_px.x(), image_px.y());
}

}  // namespace tacipc
