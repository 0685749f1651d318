// Colours as video has them: a brightness per pixel and two colour differences per four of them.
#pragma once

#include <cstdint>
#include <vector>

#include "common/image/image.h"

namespace tacipc {

/// Planes Y, Cb and Cr, the last two of half the width and height.
struct YuvImage {
  int width = 0, height = 0;
  std::vector<std::uint8_t> y, cb, cr;
};

/// With luma coefficients Kr, Kg, Kb = 0.2126, 0.7152, 0.0722 of R′G′B′ in [0, 1]:
///   Y = 16 + 219 E,  Cb = 128 + 224 (B − E)/(2 (1 − Kb)),  Cr = 128 + 224 (R − E)/(2 (1 − Kr)),  E = Kr R + Kg G + Kb
///   B,
/// colour differences of the mean of each square of four pixels.   [ITU-R BT.709-6, narrow range]
/// \pre RGB, width and height even
YuvImage yuv_of(const ByteImage& image);

/// The way back, each colour difference for its four pixels.
ByteImage rgb_of(const YuvImage& image);

}  // namespace tacipc
