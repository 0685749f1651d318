// Curves as an SVG drawing: two scales, shaded stretches, a limit, marked places.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/image/svg.h"

namespace tacipc {

/// One value per x of the chart; where there is none the line is broken.
struct Curve {
  std::vector<std::optional<double>> values;
  std::vector<std::string> titles = {};  // what a mark says when pointed at; empty: no marks
  bool broad = false;                    // wide and pale, for one that others lie on
};

/// A shaded stretch of the x axis.
struct Band {
  std::string name;
  double from = 0.0;
  double to = 0.0;
};

/// A line across the drawing at one x or y.
struct Rule {
  std::string name;
  double at = 0.0;
};

struct Chart {
  std::string what;  // for those who cannot see it
  std::string x_label;
  std::string left_label;
  std::string right_label = {};  // empty: one scale
  std::vector<double> x = {};
  bool whole_x = false;           // ticks at whole numbers only; the axis ends with the last x
  std::vector<Curve> left = {};   // drawn in colours 1, 2, …
  std::vector<Curve> right = {};  // in the colours after those
  bool logarithmic = false;       // the left scale; values not above zero are left out then
  std::vector<Band> bands = {};
  std::vector<Rule> places = {};   // upright lines
  std::optional<Rule> limit = {};  // a level line on the left scale
};

/// Both scales hold zero unless logarithmic. \pre x and curves are of one length, not zero; x is finite
std::string chart_svg(const Chart& chart);

/// The drawing above a caption (HTML).
std::string figure(const Chart& chart, const std::string& caption);

/// A short line in the colour of a curve, to stand before its name in a caption (HTML).
std::string curve_key(int color, bool broad = false);

// The frame of every drawing with axes on a page.

/// Coordinates of a drawing; the plot lies between kLeft, a right end, kTop and kBottom.
struct Drawing {
  static constexpr double kWidth = 400, kHeight = 300;
  static constexpr double kLeft = 62, kRight = 378, kTop = 24, kBottom = 248;
  static constexpr int kMaxTicks = 7;
};

/// Looks of the page's style sheet.
extern const AxesLook kPageAxes;

/// The opening tag; `what` tells those who cannot see it what is drawn.
std::string drawing_start(const std::string& what);

/// Grid, ticks and their numbers along the left and the lower side.
std::string ticks_svg(const Scale& x, const Scale& left, double right_end);

/// What the lower and the left side measure.
std::string labels_svg(const std::string& x_label, const std::string& left_label, double right_end);

/// Words that run upwards.
std::string upright_text(const char* kind, double x, double y, const char* anchor, const std::string& words);

}  // namespace tacipc
