// What SVG drawings are made of: the start of a file, axes with ticks, arrows.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "common/image/axis.h"

namespace tacipc {

/// The opening tag of a drawing that is a file of its own, on white.
std::string svg_file_start(double width, double height, int font_size);

/// Where curves lie, in drawing coordinates; y points down.
struct PlotArea {
  double left, right, top, bottom;
};

/// What axes look like. Texts are attributes: a class where the page has a style sheet, colours in a file of its own.
struct AxesLook {
  std::string grid, axis;       // of lines
  std::string x_tick, y_tick;   // of the ticks' labels
  double x_label_below = 18.0;  // baseline of labels below the area
  double y_label_left = 8.0;    // end of labels left of the area
  int decimals = 2;             // of coordinates
};

/// Of a drawing that is a file of its own.
const AxesLook& file_axes();

/// A line of the grid and its label.
struct Tick {
  double at;  // drawing coordinate
  std::string label;
};
/// Those of the scale's axis.
std::vector<Tick> ticks_of(const Scale& scale);

/// Upright lines of the grid with labels below the area; level ones with labels left of it; the two axes themselves.
std::string x_ticks_svg(const std::vector<Tick>& ticks, const PlotArea& area, const AxesLook& look);
std::string y_ticks_svg(const std::vector<Tick>& ticks, const PlotArea& area, const AxesLook& look);
std::string axes_svg(const PlotArea& area, const AxesLook& look);

/// Quivers: a dot per point, an arrow from each by a vector, all in drawing coordinates and each kind one path with the
/// attributes `look`. Of vectors shorter than a third of a unit there is nothing to see. Nothing of nothing.
std::string dots_svg(const Eigen::Matrix2Xd& at, const std::string& look);
std::string arrows_svg(const Eigen::Matrix2Xd& from, const Eigen::Matrix2Xd& by, const std::string& look);

}  // namespace tacipc
