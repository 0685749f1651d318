// The frame of every drawing with axes on a page: size, ticks, labels (SVG).
#pragma once

#include <string>

#include "common/image/svg.h"

namespace tacipc {

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
