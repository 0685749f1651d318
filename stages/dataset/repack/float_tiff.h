// Writes a picture of single-precision numbers as TIFF, which Pillow and OpenCV read back exactly.
#pragma once

#include <span>
#include <string>

namespace tacipc {

/// TIFF of one channel, row-major, row 0 at the top: one strip, deflate with the floating-point predictor (TIFF 6.0,
/// Adobe's technical notes 1 and 3).
/// \pre as many numbers as pixels
std::string float_tiff_bytes(std::span<const float> pixels, int width, int height);

}  // namespace tacipc
