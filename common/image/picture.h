// Pictures of measured images for people: a height or depth in colours, normals as colours.
#pragma once

#include <array>
#include <cstdint>

#include "common/image/image.h"

namespace tacipc {

/// Colour of t in [0, 1] (clamped), dark blue over teal and green to light yellow: lightness grows linearly in the
/// OKLab space (Ottosson 2020), so equal steps of t look equal, and a grey print keeps the order.
std::array<std::uint8_t, 3> perceptual_color(double t);

/// Colours of the first channel: `low` and below dark, `high` and above light, NaN black. \pre low < high
ByteImage picture_of_scalar(const FloatImage& image, double low, double high);

/// Colours of a height from 0 to the greatest of the image, to 1e-6 at least.
ByteImage picture_of_height(const FloatImage& image);

/// Unit vectors as colours (n + 1) / 2 per component, so a flat face is light blue (128, 128, 255); NaN black.
ByteImage picture_of_normals(const FloatImage& normals);

/// Means over squares of `by` pixels; squares at the right and the bottom may be smaller.
FloatImage means_over_squares(const ByteImage& image, int by);
/// Means over squares rounded to codes.
ByteImage reduced(const ByteImage& picture, int by);

/// Puts a picture with its upper left corner at x, y. \pre both RGB, and it lies inside the sheet
void paste(ByteImage& sheet, const ByteImage& picture, int x, int y);

}  // namespace tacipc
