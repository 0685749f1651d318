// Building blocks of SVG drawings: start of a file, axes with ticks, arrows.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "common/image/axis.h"

namespace tacipc {

/// Returns the opening tag of a stand-alone drawing on white.
std::string svg_file_start(double width, double height, int font_size);

/// Area of the curves in drawing coordinates; y points down.
struct PlotArea {
  double left, right, top, bottom;
};

/// Style of axes. Texts are SVG attributes: a class if the page has a style sheet, colours in a stand-alone file.
struct AxesLook {
  std::string grid, axis;       // attributes of lines
  std::string x_tick, y_tick;   // attributes of tick labels
  double x_label_below = 18.0;  // baseline of labels below the area
  double y_label_left = 8.0;    // end of labels left of the area
  int decimals = 2;             // decimals of coordinates
};

/// Returns the style of a stand-alone drawing.
const AxesLook& file_axes();

/// A grid line and its label.
struct Tick {
  double at;  // drawing coordinate
  std::string label;
};
/// Returns the ticks of the scale's axis.
std::vector<Tick> ticks_of(const Scale& scale);

/// Draw vertical grid lines with labels below the area, horizontal ones with labels left of it, and the two axes.
std::string x_ticks_svg(const std::vector<Tick>& ticks, const PlotArea& area, const AxesLook& look);
std::string y_ticks_svg(const std::vector<Tick>& ticks, const PlotArea& area, const AxesLook& look);
std::string axes_svg(const PlotArea& area, const AxesLook& look);

/// Draw a vector field: a dot per point, and an arrow from each point by a vector, in drawing coordinates. Dots and
/// arrows are one path each, with the attributes `look`. Vectors shorter than a third of a unit are left out. Empty
/// input gives empty text.
std::string dots_svg(const Eigen::Matrix2Xd& at, const std::string& look);
std::string arrows_svg(const Eigen::Matrix2Xd& from, const Eigen::Matrix2Xd& by, const std::string& look);

}  // namespace tacipc
