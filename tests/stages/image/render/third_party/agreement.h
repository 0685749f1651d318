// How far two renderings of one scene agree.
#pragma once

#include "common/image/image.h"

namespace tacipc {

/// √(Σ (theirs − ours)² / Σ ours²): what both leave dark adds nothing. \pre images of one shape, something is lit
double relative_rmse(const FloatImage& ours, const FloatImage& theirs);

/// Means over blocks of 2 × 2. \pre even width and height
FloatImage halved(const FloatImage& image);

/// Ours, theirs, and the difference about grey (±`span` of the brightest value is black and white), side by side at
/// half size; the pictures with the sRGB curve, the brightest value white.
ByteImage side_by_side(const FloatImage& ours, const FloatImage& theirs, double span);

}  // namespace tacipc
