// Axes of drawings: round ticks and positions of values.
#pragma once

#include <optional>
#include <string>
#include <vector>

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
/// equal, it continues to the right. \pre low ≤ high, max_ticks ≥ 3
Axis round_axis(double low, double high, int max_ticks);

/// The same for the decimal logarithms of [low, high]: ticks at powers of ten only, at least two of them; of a range of
/// more than twelve decades the highest twelve. \pre 0 < low ≤ high, max_ticks ≥ 3
Axis decade_axis(double low, double high, int max_ticks);

/// Ticks inside a range that keeps its bounds: multiples of 1, 2 or 5 times a power of ten that cut it into three to
/// eight pieces. \pre low < high
std::vector<double> ticks_inside(double low, double high);

/// The same for a range of decimal logarithms: those of 1, 2 and 5 times the powers of ten in it, or of the powers
/// alone where those would be more than eight.
std::vector<double> decade_ticks_inside(double low, double high);

/// The largest of 1, 2 or 5 times a power of ten that is not above `value`. \pre value > 0
double round_below(double value);

/// Positions of values on a drawing.
struct Scale {
  Axis axis;               // of decimal logarithms where the scale is logarithmic
  double low_at, high_at;  // drawing coordinates of the axis' ends
  bool logarithmic = false;

  /// Of a value of the axis: the logarithm where the scale is logarithmic.
  double at(double axis_value) const;
  /// Not there: cannot be drawn on a logarithmic scale.
  std::optional<double> place(std::optional<double> value) const;
  std::string tick_text(int i) const { return (logarithmic ? "1e" : "") + axis.tick_text(i); }
};

}  // namespace tacipc
