// Tables of light as Taxim's calibration writes them: polycalib.npz.
#pragma once

#include <filesystem>

#include "common/rival/slope_table.h"

namespace tacipc {

/// A NumPy archive with `bins` and three arrays of bins × bins × 6: of each bin the weights of X², Y², X Y, X, Y, 1 in
/// whole pixels X, Y of the image. They become those of x, y from −1 to 1. Taxim reads images with OpenCV, so that
/// `grad_r` is of the first channel of those, blue, and `grad_b` of red.
/// \param width \param height of the image on which the table was calibrated
/// \throw DataError if an array is missing or of another shape, or a weight is not finite
SlopeTable read_taxim_table(const std::filesystem::path& path, int width, int height);

}  // namespace tacipc
