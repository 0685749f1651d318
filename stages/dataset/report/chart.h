// Draws curves as SVG: two scales, shaded intervals, a limit, marked positions.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/image/svg.h"

namespace tacipc {

/// Values of a curve, one per x of the chart; a missing value interrupts the line.
struct Curve {
  std::vector<std::optional<double>> values;
  std::vector<std::string> titles = {};  // tooltip of each mark; empty: no marks
  bool broad = false;                    // wide and pale, for a curve below others
};

/// Shaded interval of the x axis.
struct Band {
  std::string name;
  double from = 0.0;
  double to = 0.0;
};

/// Line across the drawing at one x or y.
struct Rule {
  std::string name;
  double at = 0.0;
};

/// Content of a drawing over one x axis.
struct Chart {
  std::string what;  // alternative text
  std::string x_label;
  std::string left_label;
  std::string right_label = {};  // empty: no right scale
  std::vector<double> x = {};
  bool whole_x = false;           // ticks only at whole numbers; the axis ends at the last x
  std::vector<Curve> left = {};   // curves in colours 1, 2, …
  std::vector<Curve> right = {};  // curves in the colours after those
  bool logarithmic = false;       // logarithmic left scale; values not above zero are left out
  std::vector<Band> bands = {};
  std::vector<Rule> places = {};   // vertical lines
  std::optional<Rule> limit = {};  // horizontal line on the left scale
};

/// SVG of a chart. Both scales include zero unless logarithmic.
/// \pre x and curves have the same length, not zero; x is finite
std::string chart_svg(const Chart& chart);

/// Drawing above a caption (HTML).
std::string figure(const Chart& chart, const std::string& caption);

/// Short line in the colour of a curve, to precede its name in a caption (HTML).
std::string curve_key(int color, bool broad = false);

// Axes of all drawings on a page.

/// Coordinates of a drawing; the plot lies between kLeft, a right end, kTop and kBottom.
struct Drawing {
  static constexpr double kWidth = 400, kHeight = 300;
  static constexpr double kLeft = 62, kRight = 378, kTop = 24, kBottom = 248;
  static constexpr int kMaxTicks = 7;
};

/// Classes of the axes in the page's style sheet.
extern const AxesLook kPageAxes;

/// Opening tag; `what` is the alternative text.
std::string drawing_start(const std::string& what);

/// Grid, ticks and their numbers along the left and the lower axis.
std::string ticks_svg(const Scale& x, const Scale& left, double right_end);

/// Labels of the lower and the left axis.
std::string labels_svg(const std::string& x_label, const std::string& left_label, double right_end);

/// Vertical text that runs upwards.
std::string upright_text(const char* kind, double x, double y, const char* anchor, const std::string& words);

}  // namespace tacipc
