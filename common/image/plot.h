// Small line plots as SVG text.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace tacipc {

/// One curve of a plot.
struct PlotCurve {
  std::string label;
  std::vector<Eigen::Vector2d> points = {};
  bool dots = false;   // open circles instead of a line
  bool marks = false;  // open circles in addition to the line
};

/// A plot.
struct Plot {
  std::string title;
  std::string x_label;
  std::string y_label;
  std::vector<PlotCurve> curves = {};
  bool logarithmic = false;  // both axes; points that are not positive are left out
  bool zero_in_x = true;     // true: the x axis begins at 0; false: at the smallest value
};

/// Draws 480 × 320 pixels: axes with round ticks, one colour per curve, a legend.
std::string to_svg(const Plot& plot);

}  // namespace tacipc
