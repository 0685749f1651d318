// Reads tables of light from Taxim's calibration: polycalib.npz.
#pragma once

#include <filesystem>

#include "common/rival/slope_table.h"

namespace tacipc {

/// NumPy archive with `bins` and three arrays of bins × bins × 6: for each bin the weights of X², Y², X Y, X, Y, 1 in
/// whole pixels X, Y of the image. They are converted to weights of x, y from −1 to 1. Taxim reads images with OpenCV,
/// so `grad_r` belongs to their first channel, blue, and `grad_b` to red.
/// \param width width of the image on which the table was calibrated
/// \param height height of that image
/// \throw DataError if an array is missing or of another shape, or a weight is not finite
SlopeTable read_taxim_table(const std::filesystem::path& path, int width, int height);

}  // namespace tacipc
