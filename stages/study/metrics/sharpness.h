// Fine detail of an image relative to its reference.
#pragma once

#include "common/image/image.h"
#include "stages/study/metrics/ssim.h"

namespace tacipc {

/// σ of the Gaussian in pixels: large enough that the camera's noise, which differs in every photograph, counts little.
inline constexpr double kSharpnessSigma = 3.0;

/// Variance, over the pixels of a box, of the Laplacian of Gaussian
///   L = ∇² (G_σ ∗ g),  g = mean of the channels in codes,
/// with the 5-point ∇² and G_σ cut off at 4 σ, image mirrored at its border. Detail of the size of σ counts most; a
/// constant or a slope not at all. Variance of the Laplacian is a measure of focus [Pech-Pacheco 2000], of the
/// Gaussian's an edge detector's signal [Marr1980]. \pre the box lies in the image and is not empty
double laplacian_variance(const ByteImage& image, double sigma, const Box& box);

/// The same over that of the reference: 1 where both are as sharp, less where the image is smoother. +∞ or NaN for a
/// reference without any detail. \pre equal sizes
double sharpness(const ByteImage& image, const ByteImage& reference, const Box& box);

}  // namespace tacipc
