// Fits the colours of known LEDs to one photograph without contact.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "common/base/types.h"
#include "common/config/config.h"
#include "common/image/image.h"

namespace tacipc {

/// Section `intensities` of a calibrate configuration.
struct IntensityConfig {
  std::string curve;       // response curve of the photograph: srgb or linear
  double shot_gain = 0.0;  // noise variance of a linear value y in 0 … 1: shot_gain · y + read_noise²
  double read_noise = 0.0;
  int block_px = 1;  // width and height of the blocks whose medians are fitted; dust and markers drop out

  static IntensityConfig read(ConfigReader& file);
};

/// Fit y_c = Σ_l a_lc B_lc + b_c U with a ≥ 0 and veil b ≥ 0, where B_l is the image of LED l alone in white light and
/// U the image of a veil of 1.
struct IntensityFit {
  Eigen::Matrix<double, Eigen::Dynamic, 3> rgb;  // a, one row per LED
  Vector3 veil = Vector3::Zero();                // b
  std::array<double, 3> rmse{};                  // error in linear light, over the blocks
  double condition = 0.0;                        // condition of the LEDs' images, columns scaled to unit length
  double condition_with_veil = 0.0;
  std::array<Eigen::MatrixXd, 3> covariance = {};  // covariance of (a_c, b_c) for the given noise, ignoring bounds
  FloatImage residual;                             // fit − photograph in linear light, one pixel per block
};

/// Minimises |A x − y|, x ≥ 0, by active sets (Lawson and Hanson 1974, ch. 23) on the normal equations.
/// \throw SolverError if it does not end within 10 n steps
Eigen::VectorXd nonnegative_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& y);

/// Condition of A from AᵀA with A's columns scaled to unit length: the root of the eigenvalues' ratio.
double condition_of(const Eigen::MatrixXd& gram);

/// Fits the LEDs. Blocks whose median is 0 or 255 in a channel do not count in it.
/// \pre basis images and `codes` have three channels, the veil has one, all are of one size
/// \throw DataError if fewer blocks than unknowns are left
IntensityFit fit_intensities(const std::vector<FloatImage>& basis, const FloatImage& veil, const FloatImage& codes,
                             const IntensityConfig& config);

}  // namespace tacipc
