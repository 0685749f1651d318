// Distributions of the numbers of many samples: histograms, and maps of pairs.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "common/image/axis.h"

namespace tacipc {

/// Summary of many values.
struct Spread {
  std::size_t count = 0;
  double mean = 0.0, sum = 0.0;
  double low = 0.0, p5 = 0.0, median = 0.0, p95 = 0.0, high = 0.0;
};
/// Computes the summary; nothing without values.
/// \pre all are finite
std::optional<Spread> spread_of(std::vector<double> values);

/// Counts in bins of equal, round width, for several groups. Bin i is [tick(i), tick(i + 1)); the last bin includes its
/// upper end.
struct Histogram {
  Axis bins;                                     // ticks at the edges of the bins
  std::vector<std::vector<std::size_t>> counts;  // group × bin

  int num_bins() const { return bins.num_ticks() - 1; }
  /// Count of all groups together.
  std::size_t total(int bin) const;
  std::size_t largest() const;
};
/// Histogram over the values of all groups, with at most `max_bins` bins.
/// \pre all are finite; max_bins ≥ 2
Histogram histogram(const std::vector<std::vector<double>>& groups, int max_bins);

/// Counts in cells of a plane: frequencies of pairs of numbers.
struct PairMap {
  Axis x, y;  // axes; cells reach from their low to their high ends
  int columns = 0, rows = 0;
  std::vector<std::size_t> counts;  // row × column, row 0 at the smallest y

  std::size_t largest() const;
};
/// Map of the pairs (x, y). Axes have at most `max_ticks` ticks and include zero.
/// \pre as many x as y, all finite; max_ticks ≥ 3
PairMap pair_map(const std::vector<double>& x, const std::vector<double>& y, int columns, int rows, int max_ticks);

/// `count` of `among` positions, evenly spread and ascending, including the first; all if there are not more.
std::vector<std::size_t> evenly_chosen(std::size_t among, std::size_t count);

}  // namespace tacipc
