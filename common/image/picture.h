// Colour pictures of measured images: heights or depths, and normals.
#pragma once

#include <array>
#include <cstdint>

#include "common/image/image.h"

namespace tacipc {

/// Returns the colour of t in [0, 1] (clamped), from dark blue over teal and green to light yellow. Lightness grows
/// linearly in the OKLab space (Ottosson 2020), so that equal steps of t look equal, and a grey print keeps the order.
std::array<std::uint8_t, 3> perceptual_color(double t);

/// Colours the first channel: dark at `low` and below, light at `high` and above, NaN black.
/// \pre low < high
ByteImage picture_of_scalar(const FloatImage& image, double low, double high);

/// Colours a height from 0 to the image's maximum, which counts as at least 1e-6.
ByteImage picture_of_height(const FloatImage& image);

/// Colours unit vectors as (n + 1) / 2 per component, so that a flat face is light blue (128, 128, 255); NaN black.
ByteImage picture_of_normals(const FloatImage& normals);

/// Averages over squares of `by` pixels; squares at the right and the bottom may be smaller.
FloatImage means_over_squares(const ByteImage& image, int by);
/// Averages over squares, rounded to 8-bit values.
ByteImage reduced(const ByteImage& picture, int by);

/// Copies a picture into the sheet with its upper left corner at x, y.
/// \pre both RGB; the picture lies inside the sheet
void paste(ByteImage& sheet, const ByteImage& picture, int x, int y);

}  // namespace tacipc
