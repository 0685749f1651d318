// Round ticks for the axis of a drawing.
#pragma once

#include <string>

namespace tacipc {

/// Ticks from `low` on at multiples of a round step (1, 2 or 5 times a power of ten), as far as `high` reaches.
struct Axis {
  double low = 0.0;
  double high = 1.0;
  double step = 1.0;
  int decimals = 0;  // digits after the point that a tick needs

  int num_ticks() const;
  double tick(int i) const { return low + i * step; }
  std::string tick_text(int i) const;
};

/// The axis with the fewest and roundest ticks, at most `max_ticks` of them, that covers [low, high]. Where both are
/// equal, it goes on to the right. \pre low ≤ high, max_ticks ≥ 3
Axis round_axis(double low, double high, int max_ticks);

/// The same for the decimal logarithms of [low, high]: ticks at powers of ten only, at least two of them; of a range of
/// more than twelve decades the highest twelve. \pre 0 < low ≤ high, max_ticks ≥ 3
Axis decade_axis(double low, double high, int max_ticks);

/// The largest of 1, 2 or 5 times a power of ten that is not above `value`. \pre value > 0
double round_below(double value);

}  // namespace tacipc
