// Pixel-wise differences of two 8-bit images.
#pragma once

#include "common/image/image.h"
#include "stages/study/metrics/ssim.h"

namespace tacipc {

/// Means over pixels and channels of |a − b| and (a − b)², codes divided by 255.
struct ImageError {
  double mae = 0.0;
  double mse = 0.0;
};

/// \pre equal sizes and channels, at least one pixel
ImageError image_error(const ByteImage& a, const ByteImage& b);

/// The image with round(code + o_c) clamped to 0 … 255 in channel c, where o_c is the mean of reference − image over
/// the pixels outside the box: what least squares takes from a drift of the whole
/// picture. \pre equal sizes and channels, a pixel outside the box
ByteImage offset_to(const ByteImage& image, const ByteImage& reference, const Box& box);

/// 10 ln(1 / mse): the natural logarithm, which is what the paper's table must hold (its values exceed what any decibel
/// value can be at its MAE); 2.3026 times the decibels. +∞ for equal images.
double psnr_ln(double mse);

}  // namespace tacipc
