// Structural similarity [Wang2004] in its two common forms.
#pragma once

#include <vector>

#include "common/image/image.h"

namespace tacipc {

/// Window of the similarity. Weighted means μ, variances σ² and covariance σ_ab over a window around each pixel give
///   S = (2 μ_a μ_b + C₁)(2 σ_ab + C₂) / ((μ_a² + μ_b² + C₁)(σ_a² + σ_b² + C₂)),
///   C₁ = (0.01 · 255)², C₂ = (0.03 · 255)².
struct SsimWindow {
  std::vector<double> weights;     // weights along one axis, odd number, sum 1; the window is their outer product
  double covariance_factor = 1.0;  // N / (N − 1) for sample covariance over N pixels, 1 for population covariance

  int size() const { return static_cast<int>(weights.size()); }
};

/// SSIM-W, as Wang et al. define it: 11 × 11 Gaussian window of σ = 1.5 pixels, population covariance.
SsimWindow gaussian_window();
/// SSIM-S, the default of scikit-image, which the evaluation scripts of the paper's competitors use: 7 × 7 box, sample
/// covariance.
SsimWindow box_window();
/// Least image width and height for the larger window, px.
inline constexpr int kLeastSide = 11;

/// S of one channel at every pixel whose whole window lies in the image. Value (x, y), row-major, belongs to the pixel
/// (x + margin, y + margin).
struct SsimMap {
  int width = 0;
  int height = 0;
  int margin = 0;
  std::vector<double> values;
};

/// Computes the map of one channel.
/// \pre equal sizes and channels, both sides at least the window's
SsimMap ssim_map(const ByteImage& a, const ByteImage& b, int channel, const SsimWindow& window);

/// Mean of S over the pixels whose whole window lies in the image, per channel, then over channels.
/// \pre equal sizes and channels, both sides at least the window's
double ssim(const ByteImage& a, const ByteImage& b, const SsimWindow& window);

/// Pixels [x, x + width) × [y, y + height).
struct Box {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

/// Mean of S over the pixels of a box alone, per channel, then over channels. Windows reach beyond the box, so this is
/// not the SSIM of the part cut out. Pixels of the box that are too near the image's border for a window do not count;
/// NaN if none is left.
double ssim_in_box(const ByteImage& a, const ByteImage& b, const SsimWindow& window, const Box& box);

}  // namespace tacipc
