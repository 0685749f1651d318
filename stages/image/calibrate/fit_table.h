// Taxim's table from photographs of balls [SiYuan2022].
#pragma once

#include <vector>

#include "common/rival/slope_table.h"
#include "stages/image/calibrate/contact_pixels.h"
#include "stages/image/calibrate/rival_config.h"

namespace tacipc {

/// - one_of_each_ball, as released: per ball and bin the last pixel in raster order; bins without one take value and
/// place
///   of the nearest bin by distance of indices; then per bin and channel least squares over the balls.
/// - all: normal equations of all pixels, summed per bin, smoothed over bins (around the circle in direction); bins
/// that
///   no pixel reaches take the nearest one's weights.
/// \throw DataError if no ball has a pixel
SlopeTable fit_table(const std::vector<std::vector<ContactPixel>>& balls, int width_px, int height_px,
                     const TableFit& settings);

/// For each bin the index of the nearest of those marked, by (Δ inclination)² + (Δ direction)², around the circle where
/// wanted: itself where it is marked. \pre one is marked
std::vector<std::size_t> nearest_marked(const std::vector<bool>& marked, int bins, bool around);

}  // namespace tacipc
