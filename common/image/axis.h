// Axes of plots: round ticks, and positions of values.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tacipc {

/// Axis with ticks from `low` to `high` at multiples of a round step (1, 2 or 5 times a power of ten).
struct Axis {
  double low = 0.0;
  double high = 1.0;
  double step = 1.0;
  int decimals = 0;  // digits that a tick needs after the decimal point

  int num_ticks() const;
  double tick(int i) const { return low + i * step; }
  std::string tick_text(int i) const;
};

/// Returns the axis with the fewest and roundest ticks, at most `max_ticks`, that covers [low, high]. If both are
/// equal, it extends to the right.
/// \pre low ≤ high, max_ticks ≥ 3
Axis round_axis(double low, double high, int max_ticks);

/// Returns the axis of the decimal logarithms of [low, high]: ticks at powers of ten only, at least two. If the range
/// exceeds twelve decades, the axis covers the highest twelve.
/// \pre 0 < low ≤ high, max_ticks ≥ 3
Axis decade_axis(double low, double high, int max_ticks);

/// Returns ticks inside a range with fixed bounds: multiples of 1, 2 or 5 times a power of ten that divide it into
/// three to eight intervals.
/// \pre low < high
std::vector<double> ticks_inside(double low, double high);

/// Returns ticks inside a range of decimal logarithms: logarithms of 1, 2 and 5 times the powers of ten in it, or of
/// the powers alone if there would be more than eight.
std::vector<double> decade_ticks_inside(double low, double high);

/// Returns the largest of 1, 2 or 5 times a power of ten that is not above `value`.
/// \pre value > 0
double round_below(double value);

/// Maps values to positions in a drawing.
struct Scale {
  Axis axis;               // axis of the values, or of their decimal logarithms if the scale is logarithmic
  double low_at, high_at;  // drawing coordinates of the axis' ends
  bool logarithmic = false;

  /// Returns the position of a value of the axis; the logarithm if the scale is logarithmic.
  double at(double axis_value) const;
  /// Returns the position of a value; nothing if it is missing or cannot be drawn on a logarithmic scale.
  std::optional<double> place(std::optional<double> value) const;
  std::string tick_text(int i) const { return (logarithmic ? "1e" : "") + axis.tick_text(i); }
};

}  // namespace tacipc
