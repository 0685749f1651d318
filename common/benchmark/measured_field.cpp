#include "common/benchmark/measured_field.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <vector>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/base/statistics.h"
#include "common/format/html_text.h"
#include "common/image/svg.h"

namespace tacipc {

MarkerField read_marker_field(const std::filesystem::path& path) {
  std::istringstream text(read_file(path));
  std::string line;
  std::vector<double> rows;
  for (int number = 1; std::getline(text, line); ++number) {
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
    if (number == 1) {
      if (line != "Mx,My,dx,dy") throw DataError("{}:1: expected the header Mx,My,dx,dy", path.string());
      continue;
    }
    if (line.empty()) continue;
    double v[4];
    int end = 0;
    const bool read = std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf%n", v, v + 1, v + 2, v + 3, &end) == 4 &&
                      end == static_cast<int>(line.size());
    if (!read || !std::all_of(v, v + 4, [](double x) { return std::isfinite(x); }))
      throw DataError("{}:{}: expected four numbers", path.string(), number);
    rows.insert(rows.end(), v, v + 4);
  }
  if (rows.empty()) throw DataError("{}: has no markers", path.string());
  const Eigen::Map<Eigen::Matrix4Xd> all(rows.data(), 4, static_cast<Eigen::Index>(rows.size() / 4));
  return {.rest_px = all.topRows<2>(), .moved_px = all.bottomRows<2>()};
}

Eigen::Vector2d median_of(const Eigen::Matrix2Xd& vectors) {
  assert(vectors.cols() > 0);
  const auto x = vectors.row(0), y = vectors.row(1);
  return {median(std::vector<double>(x.begin(), x.end())), median(std::vector<double>(y.begin(), y.end()))};
}

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
