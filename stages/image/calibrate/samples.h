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

/// Pixels around one contact, and the difference of the photograph from the background there.
struct Samples {
  std::vector<std::array<int, 2>> pixels;
  Codes target;   // difference minus the drift, grey levels
  Codes used;     // 1, or 0 where the photograph or the background is clipped (grey level 0 or 255)
  Codes clipped;  // −1 or 1 where only the photograph is clipped: the true change is at most or at least `target`
  std::array<double, 3> drift{};  // mean difference far from the contact, grey levels
};

/// View and samples of one contact on its photograph.
struct Contact {
  MembraneView view;
  Samples samples;
  double rmse_codes = 0.0;  // error of the used samples, all channels
};

/// Samples at the pixels of `inside`, every `stride`-th along x and y; the pixels of `far` give the drift.
/// \throw DataError, naming the image, if no pixel is far
Samples make_samples(const ByteImage& photograph, const ByteImage& background, const std::string& image,
                     const std::function<bool(int, int)>& inside, const std::function<bool(int, int)>& far, int stride);

/// Samples around a ball.
/// \throw DataError, naming the label's image, if no pixel is far enough from the contact to determine the drift
Samples make_samples(const ByteImage& photograph, const ByteImage& background, const BallLabel& label,
                     const CalibrateConfig& config);

/// Features of all samples, one row each.
Eigen::MatrixXd feature_matrix(const LightGeometry& geometry, const MembraneView& view, const Samples& samples);

/// Active samples: `used`, and clipped samples whose simulated change lies on the wrong side of the clipped level.
Codes active_samples(const Samples& samples, const Codes& simulated);

/// Residuals of all samples, channel after channel; 0 where a sample is not active.
Eigen::VectorXd residuals_of(const Samples& samples, const Eigen::MatrixXd& features, const Codes& weights);

/// Normal equations over the used samples, per channel: Aᵀ A, Aᵀ y, yᵀ y and the number of rows.
struct NormalEquations {
  std::array<Eigen::MatrixXd, 3> gram;
  std::array<Eigen::VectorXd, 3> moment;
  std::array<double, 3> square{};
  std::array<double, 3> count{};

  void add(const NormalEquations& other);
  /// Part with the features first … last − 1 alone.
  NormalEquations part(Eigen::Index first, Eigen::Index last) const;
  /// Minimises |A w − y|² + ridge Σ (AᵀA)_ii w_i² in each channel.
  /// \throw SolverError if the system is singular
  Codes solve(double ridge) const;
  /// Residual |A w − y|² of given weights, per channel.
  std::array<double, 3> residual(const Codes& weights) const;
  /// Condition of the worst channel: root of the largest over the smallest eigenvalue of AᵀA scaled to unit diagonal.
  double condition() const;
};

/// Normal equations over the samples where `active` is 1.
NormalEquations normal_equations(const Eigen::MatrixXd& features, const Samples& samples, const Codes& active);

}  // namespace tacipc
