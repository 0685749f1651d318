#include "stages/marker_fit/quiver.h"

#include <fmt/format.h>

namespace tacipc {

std::string quiver_svg(const MarkerField& measured, const Eigen::Matrix2Xd& simulated_px,
                       const Eigen::Vector2d& image_px, double enlarged, const std::string& title) {
  constexpr double kScale = 2.0, kFoot = 36.0;
  const double width = kScale * image_px.x(), height = kScale * image_px.y();
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:g} {1:g}\" width=\"{0:g}\" height=\"{1:g}\" "
      "font-family=\"sans-serif\" font-size=\"13\">\n<rect width=\"{0:g}\" height=\"{1:g}\" fill=\"white\"/>\n"
      "<rect width=\"{0:g}\" height=\"{2:g}\" fill=\"none\" stroke=\"#888\"/>\n",
      width, height + kFoot, height);
  for (Eigen::Index i = 0; i < measured.rest_px.cols(); ++i) {
    const Eigen::Vector2d rest = kScale * measured.rest_px.col(i);
    const auto line = [&](const Eigen::Vector2d& moved, const char* color) {
      const Eigen::Vector2d end = rest + kScale * enlarged * moved;
      out += fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" stroke=\"{}\" stroke-width=\"1.6\"/>", rest.x(),
                         rest.y(), end.x(), end.y(), color);
    };
    line(measured.moved_px.col(i), "#c22626");
    line(simulated_px.col(i), "#1f5fa8");
    out += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.2\" fill=\"#2c8a3c\"/>\n", rest.x(), rest.y());
  }
  return out + fmt::format(
                   "<text x=\"6\" y=\"{:.1f}\">{}: <tspan fill=\"#c22626\">measured</tspan>, <tspan "
                   "fill=\"#1f5fa8\">simulated</tspan>, lines {:g} times as long; image {:g} × {:g} px</text>\n"
                   "</svg>\n",
                   height + 22.0, title, enlarged, image_px.x(), image_px.y());
}

}  // namespace tacipc
