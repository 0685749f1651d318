#include "stages/dataset/report/quiver.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "common/image/svg.h"

namespace tacipc {
namespace {

constexpr double kQuiverWidth = 400, kMaxHeight = 400, kFooter = 28, kQuiverMargin = 8;
/// Shorter displacements are numerical noise and appear as dots.
constexpr double kNothingMm = 1e-6;
constexpr const char* kArrows = "class=\"arrows\"";

/// Transforms mm on the front into the drawing.
struct FrontDrawing {
  View view;
  double per_mm;
  double height;

  explicit FrontDrawing(const View& v)
      : view(v),
        per_mm(std::min((kQuiverWidth - 2 * kQuiverMargin) / (v.high_x - v.low_x),
                        (kMaxHeight - 2 * kQuiverMargin) / (v.high_y - v.low_y))),
        height(per_mm * (v.high_y - v.low_y) + 2 * kQuiverMargin) {}
  double x(double x_mm) const { return 0.5 * kQuiverWidth + per_mm * (x_mm - 0.5 * (view.low_x + view.high_x)); }
  double y(double y_mm) const { return kQuiverMargin + per_mm * (y_mm - view.low_y); }
};

/// Contacts as one dot per cell of a few drawing units, so that the picture stays small for any gel. In a mixed cell
/// the slipping ones show.
std::string contacts_svg(const std::vector<ContactPoint>& contacts, const FrontDrawing& drawing) {
  constexpr double kCell = 3.0;
  std::map<std::pair<long, long>, bool> cells;
  for (const ContactPoint& point : contacts) {
    const std::pair cell{std::lround(drawing.y(point.y_mm) / kCell), std::lround(drawing.x(point.x_mm) / kCell)};
    cells[cell] = cells[cell] || point.slips;
  }
  std::string paths[2];
  for (const auto& [cell, slips] : cells) {
    paths[slips ? 1 : 0] +=
        fmt::format("M{:g} {:g}h0", kCell * static_cast<double>(cell.second), kCell * static_cast<double>(cell.first));
  }
  std::string svg;
  if (!paths[0].empty()) svg += "<path class=\"stuck\" d=\"" + paths[0] + "\"/>\n";
  if (!paths[1].empty()) svg += "<path class=\"slipping\" d=\"" + paths[1] + "\"/>\n";
  return svg;
}

/// Smallest distance between two markers; infinite for a single one.
double spacing_mm(const std::vector<MarkerArrow>& arrows) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < arrows.size(); ++i)
    least = std::min(least, std::hypot(arrows[i].x_mm - arrows[0].x_mm, arrows[i].y_mm - arrows[0].y_mm));
  return least;
}

}  // namespace

View view_of(const std::vector<MarkerPicture>& pictures) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity(), kBorderMm = 0.6;
  View view{kInfinity, -kInfinity, kInfinity, -kInfinity};
  const auto include = [&](double x, double y) {
    view = {std::min(view.low_x, x), std::max(view.high_x, x), std::min(view.low_y, y), std::max(view.high_y, y)};
  };
  for (const MarkerPicture& picture : pictures) {
    for (const MarkerArrow& arrow : picture.arrows) include(arrow.x_mm, arrow.y_mm);
    for (const ContactPoint& point : picture.contacts) include(point.x_mm, point.y_mm);
  }
  if (view.low_x > view.high_x) return {};
  return {view.low_x - kBorderMm, view.high_x + kBorderMm, view.low_y - kBorderMm, view.high_y + kBorderMm};
}

double longest_mm(const std::vector<MarkerArrow>& arrows) {
  double longest = 0.0;
  for (const MarkerArrow& arrow : arrows) longest = std::max(longest, std::hypot(arrow.dx_mm, arrow.dy_mm));
  return longest;
}

double arrow_scale(const std::vector<MarkerArrow>& arrows) {
  const double longest = longest_mm(arrows), apart = spacing_mm(arrows);
  if (longest < kNothingMm || !std::isfinite(apart) || !(apart > 0)) return 1.0;
  return round_below(apart / longest);
}

std::string quiver_svg(const MarkerPicture& picture, const View& view) {
  const FrontDrawing drawing(view);
  const double scale = arrow_scale(picture.arrows), longest = longest_mm(picture.arrows);
  const auto count = static_cast<Eigen::Index>(picture.arrows.size());
  Eigen::Matrix2Xd at(2, count), by(2, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const MarkerArrow& a = picture.arrows[static_cast<std::size_t>(i)];
    const double draw = std::hypot(a.dx_mm, a.dy_mm) >= kNothingMm ? scale * drawing.per_mm : 0.0;
    at.col(i) << drawing.x(a.x_mm), drawing.y(a.y_mm);
    by.col(i) << draw * a.dx_mm, draw * a.dy_mm;
  }
  const double height = drawing.height + kFooter, row = drawing.height + 0.5 * kFooter;
  std::string svg = fmt::format(
      "<svg class=\"quiver\" viewBox=\"0 0 {} {:.0f}\" role=\"img\" aria-label=\"marker displacement in frame {}\">\n"
      "<rect class=\"face\" x=\"{:.1f}\" y=\"{}\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n",
      kQuiverWidth, height, picture.frame, drawing.x(view.low_x), kQuiverMargin,
      drawing.per_mm * (view.high_x - view.low_x), drawing.per_mm * (view.high_y - view.low_y));
  svg += contacts_svg(picture.contacts, drawing);
  svg += dots_svg(at, "class=\"dots\"") + arrows_svg(at, by, kArrows);
  if (longest >= kNothingMm) {
    const double known_mm = round_below(longest), length = scale * drawing.per_mm * known_mm;
    svg += arrows_svg(Eigen::Vector2d(drawing.x(view.low_x), row), Eigen::Vector2d(length, 0), kArrows);
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{:g} mm (drawn × {:g})</text>\n",
                       drawing.x(view.low_x) + length + 8, row + 4, known_mm, scale);
  } else if (!picture.arrows.empty()) {
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">no marker moved by a nanometre</text>\n", drawing.x(view.low_x),
                       row + 4);
  }
  return svg + "</svg>\n";
}

}  // namespace tacipc
