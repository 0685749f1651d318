// Draws distributions as SVG.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "stages/dataset/report/dataset/coverage.h"

namespace tacipc {

/// Bars of a histogram, its groups stacked in colours 1, 2, …. `what` is the alternative text.
std::string histogram_svg(const Histogram& histogram, const std::vector<std::string>& groups, const std::string& what,
                          const std::string& x_label);

/// Cells of a map of pairs. Darkness grows with the logarithm of the count, so that single samples are visible.
std::string pair_map_svg(const PairMap& map, const std::string& what, const std::string& x_label,
                         const std::string& y_label);

/// A row per name: a line from the smallest to the largest value, a bar from the 5th to the 95th percentile, and a mark
/// at the median.
std::string spreads_svg(const std::vector<std::pair<std::string, Spread>>& rows, const std::string& what,
                        const std::string& x_label);

}  // namespace tacipc
