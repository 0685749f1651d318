// Measures the fine detail of an image relative to its reference.
#pragma once

#include "common/image/image.h"
#include "stages/study/metrics/ssim.h"

namespace tacipc {

/// σ of the Gaussian, px: large enough that camera noise, which differs in every photograph, counts little.
inline constexpr double kSharpnessSigma = 3.0;

/// Variance, over the pixels of a box, of the Laplacian of Gaussian
///   L = ∇² (G_σ ∗ g),  g = mean of the channels in grey levels,
/// with the 5-point ∇² and G_σ cut off at 4 σ; the image is mirrored at its border. Detail of size σ counts most, a
/// constant or a slope not at all. The variance of the Laplacian is a measure of focus [Pech-Pacheco 2000]; the
/// Laplacian of Gaussian is the signal of an edge detector [Marr1980].
/// \pre the box lies in the image and is not empty
double laplacian_variance(const ByteImage& image, double sigma, const Box& box);

/// Ratio of the image's variance to that of the reference: 1 if both are equally sharp, less if the image is smoother.
/// +∞ or NaN for a reference without any detail.
/// \pre equal sizes
double sharpness(const ByteImage& image, const ByteImage& reference, const Box& box);

}  // namespace tacipc
