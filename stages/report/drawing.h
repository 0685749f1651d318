// The frame of every drawing with axes: size, scales, ticks, labels (SVG).
#pragma once

#include <optional>
#include <string>

#include "stages/report/axis.h"

namespace tacipc {

/// Coordinates of a drawing; the plot lies between kLeft, a right end, kTop and kBottom.
struct Drawing {
  static constexpr double kWidth = 400, kHeight = 300;
  static constexpr double kLeft = 62, kRight = 378, kTop = 24, kBottom = 248;
  static constexpr int kMaxTicks = 7;
};

/// Where values come to lie on the drawing.
struct Scale {
  Axis axis;
  double low_at, high_at;  // drawing coordinates of the axis' ends
  bool logarithmic = false;

  /// Not there: cannot be drawn on a logarithmic scale.
  std::optional<double> place(std::optional<double> value) const;
  std::string tick_text(int i) const { return (logarithmic ? "1e" : "") + axis.tick_text(i); }
};

/// The opening tag; `what` tells those who cannot see it what is drawn.
std::string drawing_start(const std::string& what);

/// Grid, ticks and their numbers along the left and the lower side.
std::string ticks_svg(const Scale& x, const Scale& left, double right_end);

/// What the lower and the left side measure.
std::string labels_svg(const std::string& x_label, const std::string& left_label, double right_end);

/// Words that run upwards.
std::string upright_text(const char* kind, double x, double y, const char* anchor, const std::string& words);

}  // namespace tacipc
