#include "common/image/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tacipc {
namespace {

std::string with_space(const std::string& attributes) { return attributes.empty() ? "" : " " + attributes; }

/// Returns the path of an arrow's shaft and head.
std::string arrow_path(const Eigen::Vector2d& from, const Eigen::Vector2d& by) {
  const double length = std::hypot(by.x(), by.y());
  if (length < 0.3) return "";
  const double head = std::min(5.0, 0.45 * length), ux = by.x() / length, uy = by.y() / length;
  return fmt::format("M{:.1f} {:.1f}l{:.1f} {:.1f}m{:.1f} {:.1f}l{:.1f} {:.1f}l{:.1f} {:.1f}", from.x(), from.y(),
                     by.x(), by.y(), -head * (ux + 0.5 * uy), -head * (uy - 0.5 * ux), head * (ux + 0.5 * uy),
                     head * (uy - 0.5 * ux), -head * (ux - 0.5 * uy), -head * (uy + 0.5 * ux));
}

std::string path_svg(const std::string& data, const std::string& look) {
  return data.empty() ? "" : fmt::format("<path{} d=\"{}\"/>\n", with_space(look), data);
}

}  // namespace

const AxesLook& file_axes() {
  static const AxesLook kLook{.grid = "stroke=\"#ddd\"",
                              .axis = "fill=\"none\" stroke=\"#444\"",
                              .x_tick = "",
                              .y_tick = "",
                              .x_label_below = 15.0,
                              .y_label_left = 5.0,
                              .decimals = 1};
  return kLook;
}

std::string svg_file_start(double width, double height, int font_size) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:g} {1:g}\" width=\"{0:g}\" height=\"{1:g}\" "
      "font-family=\"sans-serif\" font-size=\"{2}\">\n<rect width=\"{0:g}\" height=\"{1:g}\" fill=\"white\"/>\n",
      width, height, font_size);
}

std::vector<Tick> ticks_of(const Scale& scale) {
  std::vector<Tick> ticks;
  for (int i = 0; i < scale.axis.num_ticks(); ++i) ticks.push_back({scale.at(scale.axis.tick(i)), scale.tick_text(i)});
  return ticks;
}

std::string x_ticks_svg(const std::vector<Tick>& ticks, const PlotArea& area, const AxesLook& look) {
  std::string svg;
  for (const Tick& tick : ticks)
    svg += fmt::format(
        "<path d=\"M{0:.{7}f} {1:.{7}f}V{2:.{7}f}\"{3}/><text{4} x=\"{0:.{7}f}\" y=\"{5:.{7}f}\" "
        "text-anchor=\"middle\">{6}</text>\n",
        tick.at, area.top, area.bottom, with_space(look.grid), with_space(look.x_tick),
        area.bottom + look.x_label_below, tick.label, look.decimals);
  return svg;
}

std::string y_ticks_svg(const std::vector<Tick>& ticks, const PlotArea& area, const AxesLook& look) {
  constexpr double kBaseline = 4.0;  // offset of the baseline below the middle of digits
  std::string svg;
  for (const Tick& tick : ticks)
    svg += fmt::format(
        "<path d=\"M{0:.{8}f} {1:.{8}f}H{2:.{8}f}\"{3}/><text{4} x=\"{5:.{8}f}\" y=\"{6:.{8}f}\" "
        "text-anchor=\"end\">{7}</text>\n",
        area.left, tick.at, area.right, with_space(look.grid), with_space(look.y_tick), area.left - look.y_label_left,
        tick.at + kBaseline, tick.label, look.decimals);
  return svg;
}

std::string axes_svg(const PlotArea& area, const AxesLook& look) {
  return fmt::format("<path d=\"M{0:.{5}f} {1:.{5}f}V{2:.{5}f}H{3:.{5}f}\"{4}/>\n", area.left, area.top, area.bottom,
                     area.right, with_space(look.axis), look.decimals);
}

std::string dots_svg(const Eigen::Matrix2Xd& at, const std::string& look) {
  std::string data;
  for (const auto& dot : at.colwise()) data += fmt::format("M{:.1f} {:.1f}h0", dot.x(), dot.y());
  return path_svg(data, look);
}

std::string arrows_svg(const Eigen::Matrix2Xd& from, const Eigen::Matrix2Xd& by, const std::string& look) {
  assert(from.cols() == by.cols());
  std::string data;
  for (Eigen::Index i = 0; i < from.cols(); ++i) data += arrow_path(from.col(i), by.col(i));
  return path_svg(data, look);
}

}  // namespace tacipc
