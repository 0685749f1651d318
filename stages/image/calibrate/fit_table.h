// Fits Taxim's table to photographs of balls [SiYuan2022].
#pragma once

#include <vector>

#include "common/rival/slope_table.h"
#include "stages/image/calibrate/contact_pixels.h"
#include "stages/image/calibrate/rival_config.h"

namespace tacipc {

/// Fits the table by one of two methods.
/// - one_of_each_ball, as released: per ball and bin the last pixel in raster order. Bins without a pixel take value
/// and position of the nearest bin by distance of indices. Then least squares over the balls, per bin and channel.
/// - all: normal equations of all pixels, summed per bin and smoothed over bins (around the circle in direction). Bins
/// that no pixel reaches take the weights of the nearest one.
/// \throw DataError if no ball has a pixel
SlopeTable fit_table(const std::vector<std::vector<ContactPixel>>& balls, int width_px, int height_px,
                     const TableFit& settings);

/// For each bin the index of the nearest marked bin, by (Δ inclination)² + (Δ direction)², around the circle if
/// `around` is set; a marked bin gives itself.
/// \pre one bin is marked
std::vector<std::size_t> nearest_marked(const std::vector<bool>& marked, int bins, bool around);

}  // namespace tacipc
