// A whole sensor from photographs: colours of its known LEDs, the veil, and a few values of its geometry.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "stages/image/calibrate/block_light.h"
#include "stages/image/calibrate/sensor_fit_config.h"
#include "stages/image/calibrate/sensor_parameters.h"

namespace tacipc {

struct BallPhotograph {
  ByteImage image;
  BallLabel label;
};

/// Fit of one photograph.
struct PhotographFit {
  std::string name;
  FloatImage residual;                  // fit − photograph in codes, a pixel per block; NaN where it does not count
  std::array<double, 3> rmse_codes{};   // over the blocks that count
  std::array<std::size_t, 3> blocks{};  // that count
};

struct BallFit {
  std::string image;
  BallPlace place;
  Eigen::Vector3d offsets_px = Eigen::Vector3d::Zero();  // of the label's centre and radius
  Eigen::Vector3d sigma_px = Eigen::Vector3d::Zero();    // 0: the label was taken as exact
};

struct SensorFit {
  Eigen::VectorXd u;                             // the parameters, in prior deviations from the prior's mean
  Eigen::MatrixXd covariance;                    // of u; balls and colours are free beside it
  std::vector<bool> at_bound;                    // per parameter
  Eigen::Matrix<double, Eigen::Dynamic, 3> rgb;  // per light group, at exposure 1
  Vector3 veil = Vector3::Zero();
  Eigen::Matrix<double, Eigen::Dynamic, 3> color_sigma;  // of the groups' colours, then of the veil
  std::vector<BallFit> balls;
  std::vector<PhotographFit> photographs;  // the one without contact, then those of balls
  double sigma_codes = 0.0;                // taken for a block's uncertainty in the end
  std::size_t outliers = 0;                // blocks and channels left out because nothing explains them
  double condition = 0.0;                  // of the parameters' Jacobian with the priors, columns scaled to unit length
  double condition_leds = 0.0;             // of the groups' images alike, worst channel
  double condition_with_veil = 0.0;
  int iterations = 0;
  bool converged = false;
};

/// Minimises over parameters u and, for each ball, offsets o of its label
///   Σ ((code(A(u, o) a) − code seen) / σ)² + |u|² + |o / σ_label|²
/// by damped Gauss–Newton, where the colours and the veil a ≥ 0 are the non-negative least squares of the linear signal
/// at that u and o, weighted by the curve's slope (variable projection, Golub and Pereyra 1973, 2003). Up to three
/// times over: blocks beyond five robust deviations go, and σ becomes the residuals' root mean square if that is larger
/// than `sigma_codes`, so that a model that does not fit leaves the priors in force. \throw UsageError if block_px does
/// not divide the image's size; DataError if a light group lights nothing that counts, or fewer blocks count than there
/// are colours.
SensorFit fit_sensor(const SensorParameters& parameters, const SensorFitConfig& config, const ByteImage& background,
                     const std::vector<BallPhotograph>& balls, const BallPress* press);

/// What the sensor file says of a fit: parameters, colours with the largest of them 1, exposure, ambient, no white
/// balance and colour matrix (they are in the colours), and the name of the photograph without contact.
/// \throw DataError if all colours are 0
std::vector<SensorChange> fitted_changes(const SensorParameters& parameters, const SensorFit& fit,
                                         const std::string& reference_image);

}  // namespace tacipc
