// Samples of the photographs for the fit, and the linear algebra common to all fits.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "common/benchmark/ball_labels.h"
#include "common/image/image.h"
#include "common/sensor/light_field.h"
#include "common/sensor/membrane_view.h"
#include "stages/image/calibrate/calibrate_config.h"

namespace tacipc {

using Codes = Eigen::Matrix<double, Eigen::Dynamic, 3>;

/// Pixels about one contact and by how many codes the photograph differs there from the background.
struct Samples {
  std::vector<std::array<int, 2>> pixels;
  Codes target;                   // codes, less the drift
  Codes used;                     // 1, or 0 where the photograph or the background is clipped (code 0 or 255)
  Codes clipped;                  // −1 or 1 where the photograph alone is: the change is at most, at least `target`
  std::array<double, 3> drift{};  // mean difference far from the contact, codes
};

/// What is seen of one contact on its photograph.
struct Contact {
  MembraneView view;
  Samples samples;
  double rmse_codes = 0.0;  // of the samples used, all channels
};

/// Pixels of `inside`, every `stride`-th along x and y; the drift is that of the pixels of `far`.
/// \throw DataError, naming the image, if no pixel is far.
Samples make_samples(const ByteImage& photograph, const ByteImage& background, const std::string& image,
                     const std::function<bool(int, int)>& inside, const std::function<bool(int, int)>& far, int stride);

/// Those about a ball. \throw DataError, naming the label's image, if no pixel lies far enough from the contact to
/// determine the drift.
Samples make_samples(const ByteImage& photograph, const ByteImage& background, const BallLabel& label,
                     const CalibrateConfig& config);

/// Features of all samples, one row each.
Eigen::MatrixXd feature_matrix(const LightGeometry& geometry, const MembraneView& view, const Samples& samples);

/// `used`, and clipped samples where the light is on the wrong side of the clipped code.
Codes active_samples(const Samples& samples, const Codes& simulated);

/// Residuals of all samples, channel after channel; 0 where a sample is not active.
Eigen::VectorXd residuals_of(const Samples& samples, const Eigen::MatrixXd& features, const Codes& weights);

/// Aᵀ A, Aᵀ y, yᵀ y and the number of rows, per channel, over the samples used.
struct NormalEquations {
  std::array<Eigen::MatrixXd, 3> gram;
  std::array<Eigen::VectorXd, 3> moment;
  std::array<double, 3> square{};
  std::array<double, 3> count{};

  void add(const NormalEquations& other);
  /// Features first … last − 1 alone.
  NormalEquations part(Eigen::Index first, Eigen::Index last) const;
  /// Minimises |A w − y|² + ridge Σ (AᵀA)_ii w_i² in each channel. \throw SolverError if the system is singular.
  Codes solve(double ridge) const;
  /// |A w − y|² of given weights, per channel.
  std::array<double, 3> residual(const Codes& weights) const;
  /// Largest over smallest eigenvalue's square root of AᵀA scaled to unit diagonal; the worst channel.
  double condition() const;
};

/// Over the samples where `active` is 1.
NormalEquations normal_equations(const Eigen::MatrixXd& features, const Samples& samples, const Codes& active);

}  // namespace tacipc
