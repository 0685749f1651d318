// Small line plots as SVG text.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace tacipc {

struct PlotCurve {
  std::string label;
  std::vector<Eigen::Vector2d> points = {};
  bool dots = false;   // open circles instead of a line
  bool marks = false;  // open circles beside the line
};

struct Plot {
  std::string title;
  std::string x_label;
  std::string y_label;
  std::vector<PlotCurve> curves = {};
  bool logarithmic = false;  // both axes; points that are not positive are left out
  bool zero_in_x = true;     // the axis begins at 0, or at the least value
};

/// 480 × 320 pixels, axes with round ticks, one colour per curve, a legend.
std::string to_svg(const Plot& plot);

}  // namespace tacipc
