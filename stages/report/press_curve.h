// Press force over indentation depth as an SVG drawing.
#pragma once

#include <string>
#include <vector>

#include "stages/report/sample.h"

namespace tacipc {

/// Ticks at multiples of a round step (1, 2 or 5 times a power of ten).
struct Axis {
  double low = 0.0;
  double high = 1.0;
  double step = 1.0;
  int decimals = 0;  // digits after the point that a tick needs

  int num_ticks() const;
  double tick(int i) const { return low + i * step; }
};

/// The axis with the fewest and roundest ticks, at most `max_ticks` of them, that covers [low, high]. Where both are
/// equal, it goes on to the right. \pre low ≤ high, max_ticks ≥ 3
Axis round_axis(double low, double high, int max_ticks);

/// One mark per frame, joined by a line; axes in mm and N with ticks. \pre at least one frame
std::string press_curve_svg(const std::vector<FrameReport>& frames);

}  // namespace tacipc
