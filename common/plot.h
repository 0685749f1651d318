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
};

/// 480 × 320 pixels, axes with round ticks, one colour per curve, a legend.
std::string to_svg(const Plot& plot);

/// Steps of 1, 2 or 5 times a power of ten that cut [low, high] into three to eight pieces: the ticks inside.
std::vector<double> round_ticks(double low, double high);

/// Ticks of a logarithmic axis: the decimal logarithms of 1, 2 and 5 times the powers of ten in [10^low, 10^high], or
/// of the powers alone where those would be more than eight.
std::vector<double> decade_ticks(double low, double high);

}  // namespace tacipc
