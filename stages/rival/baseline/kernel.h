// Convolution kernels of the depth-based simulators, and convolution in their form.
#pragma once

#include "common/image/image.h"
#include "stages/rival/baseline/raster.h"

namespace tacipc {

/// g(n, σ): SciPy's gaussian_filter (truncated at 4 σ, samples mirrored about the edge between pixels) of a unit
/// impulse at index n/2 of n zeros, along each axis: a separable n × n kernel. The filter reaches beyond the window, so
/// its mass folds back and the sum stays 1; for even n it is not symmetric. [Gomes2021]
/// \pre size > 0, sigma > 0
std::vector<double> folded_gaussian_profile(int size, double sigma);
Raster folded_gaussian(int size, double sigma);

/// Kernel w(i, j) = 201 / (200 + exp (√(i² + j²) / f)), |i|, |j| ≤ 6 f to the nearest whole number, divided by its sum.
/// f = 1 gives the older 13 × 13 kernel with which Tacchi compares [Tacchi2023]; other f give it on pixels of another
/// size.
/// \pre f > 0
Raster exponential_kernel(double factor = 1.0);

/// Values outside the image: mirrored about the outermost pixel centres, or constant.
enum class Border { reflect_101, constant };

/// Correlation Σ k(i, j) f(x + i − w/2, y + j − h/2) with the anchor at index size/2. Outside the image f is mirrored
/// about the outermost pixel centres, or is `outside`.
/// \pre a mirrored image is wider and higher than half the kernel
Raster correlate(const Raster& image, const Raster& kernel, Border border = Border::reflect_101, double outside = 0.0);

/// Profile exp(−i²/2σ²), |i| ≤ half to the nearest whole number, divided by its sum.
/// \pre sigma > 0
std::vector<double> cut_gaussian_profile(double half, double sigma);

/// Profile of OpenCV's Gaussian window of n pixels without a σ. n = 3, 5 and 7 use a table ([1 4 6 4 1]/16 for 5);
/// other n use σ = 0.3 ((n − 1)/2 − 1) + 0.8, cut at ±(n − 1)/2. On pixels 1/factor times as large, it is a Gaussian
/// whose σ (the table's standard deviation) and half width keep their length.
/// \pre n odd, at least 3; factor > 0
std::vector<double> window_profile(int size_px, double factor);

/// Correlation with profile(x) profile(y) as a separable filter, mirrored about the outermost pixel centres.
Raster correlate_separable(const Raster& image, const std::vector<double>& profile);

/// Slopes of a height into the gel along columns and rows, by central differences. Border pixels have the slopes of
/// their inner neighbour, as in Taxim and FOTS.
/// \pre at least 3 × 3 pixels
struct Slopes {
  Raster x, y;
};
Slopes slopes_of(const Raster& height_m, double pixel_m);

/// Applies correlate_separable to every channel.
FloatImage correlate_channels(const FloatImage& image, const std::vector<double>& profile);

/// Turns off OpenCV's own threads, which would ignore --threads.
void keep_to_one_thread();

}  // namespace tacipc
