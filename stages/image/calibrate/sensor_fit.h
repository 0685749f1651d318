// Fits a whole sensor to photographs: colours of its known LEDs, the veil, and a few values of its geometry.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "stages/image/calibrate/block_light.h"
#include "stages/image/calibrate/sensor_fit_config.h"
#include "stages/image/calibrate/sensor_parameters.h"

namespace tacipc {

/// Photograph of a ball, and its label.
struct BallPhotograph {
  ByteImage image;
  BallLabel label;
};

/// Fit of one photograph.
struct PhotographFit {
  std::string name;
  FloatImage residual;  // fit − photograph in grey levels, one pixel per block; NaN where a block does not count
  std::array<double, 3> rmse_codes{};   // error over the blocks that count
  std::array<std::size_t, 3> blocks{};  // number of blocks that count
};

/// Fitted position of one ball.
struct BallFit {
  std::string image;
  BallPlace place;
  Eigen::Vector3d offsets_px = Eigen::Vector3d::Zero();  // offsets of the label's centre and radius
  Eigen::Vector3d sigma_px = Eigen::Vector3d::Zero();    // standard deviations; 0: the label was assumed exact
};

/// Fitted sensor, with uncertainties and errors.
struct SensorFit {
  Eigen::VectorXd u;                             // parameters, in prior standard deviations from the prior's mean
  Eigen::MatrixXd covariance;                    // covariance of u with balls and colours free
  std::vector<bool> at_bound;                    // true for each parameter at a bound
  Eigen::Matrix<double, Eigen::Dynamic, 3> rgb;  // colour of each light group, at exposure 1
  Vector3 veil = Vector3::Zero();
  Eigen::Matrix<double, Eigen::Dynamic, 3> color_sigma;  // standard deviations of the groups' colours, then of the veil
  std::vector<BallFit> balls;
  std::vector<PhotographFit> photographs;  // the photograph without contact, then those of balls
  double sigma_codes = 0.0;                // final uncertainty of a block
  std::size_t outliers = 0;                // number of blocks and channels left out because no parameters explain them
  double condition = 0.0;       // condition of the parameters' Jacobian with the priors, columns scaled to unit length
  double condition_leds = 0.0;  // condition of the groups' images, columns scaled to unit length, worst channel
  double condition_with_veil = 0.0;
  int iterations = 0;
  bool converged = false;
};

/// Fits the sensor. Over parameters u and, for each ball, offsets o of its label, it minimises
///   Σ ((level(A(u, o) a) − measured level) / σ)² + |u|² + |o / σ_label|²
/// by damped Gauss–Newton. Colours and veil a ≥ 0 are the non-negative least squares of the linear signal at that u and
/// o, weighted by the curve's slope (variable projection, Golub and Pereyra 1973, 2003). The fit is repeated up to
/// three times: blocks beyond five robust standard deviations are removed, and σ becomes the residuals' root mean
/// square if that exceeds `sigma_codes`. A model that does not fit therefore leaves the priors in force.
/// \throw UsageError if block_px does not divide the image's size
/// \throw DataError if a light group lights no block that counts, or fewer blocks count than there are colours
SensorFit fit_sensor(const SensorParameters& parameters, const SensorFitConfig& config, const ByteImage& background,
                     const std::vector<BallPhotograph>& balls, const BallPress* press);

/// Changes of the sensor file by a fit: parameters, colours with the largest of them 1, exposure, ambient, and the name
/// of the photograph without contact. White balance and colour matrix are removed, because the colours contain them.
/// \throw DataError if all colours are 0
std::vector<SensorChange> fitted_changes(const SensorParameters& parameters, const SensorFit& fit,
                                         const std::string& reference_image);

}  // namespace tacipc
