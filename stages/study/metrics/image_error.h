// Pixel-wise differences of two 8-bit images.
#pragma once

#include "common/image/image.h"
#include "stages/study/metrics/ssim.h"

namespace tacipc {

/// Means over pixels and channels of |a − b| and (a − b)², grey levels divided by 255.
struct ImageError {
  double mae = 0.0;
  double mse = 0.0;
};

/// Computes both errors.
/// \pre equal sizes and channels, at least one pixel
ImageError image_error(const ByteImage& a, const ByteImage& b);

/// Image corrected for a drift of the whole picture: round(level + o_c) clamped to 0 … 255 in channel c, where o_c is
/// the mean of reference − image over the pixels outside the box (least squares).
/// \pre equal sizes and channels, a pixel outside the box
ByteImage offset_to(const ByteImage& image, const ByteImage& reference, const Box& box);

/// Value 10 ln(1 / mse), with the natural logarithm; 2.3026 times the decibels. The paper's table must use it, because
/// its values exceed any decibel value that its MAE permits. +∞ for equal images.
double psnr_ln(double mse);

}  // namespace tacipc
