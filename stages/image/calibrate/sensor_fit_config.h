// Section `sensor_fit` of a calibrate configuration.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "common/config/config.h"

namespace tacipc {

/// Free value of the sensor file and its prior: mean ± sigma, within bounds, in the units of its name.
struct FreeParameter {
  std::string name;
  double sigma = 0.0;
  std::optional<double> mean = std::nullopt;                   // absent: the value in the file
  std::optional<std::array<double, 2>> bounds = std::nullopt;  // absent: mean ± 4 sigma, limited to valid sensors
};

/// Photographs of a ball pressed to labelled contacts.
struct FitBalls {
  double radius_m = 0.0;
  double contact_gap_m = 0.0;   // gap between ball and membrane at the rim of the labels
  double label_sigma_px = 0.0;  // standard deviation of centre and radius; 0: labels are exact
  // Radius around a label's centre within which blocks count; absent: twice the largest radius of a label.
  std::optional<double> fit_radius_px = std::nullopt;
};

/// Settings of the sensor fit.
struct SensorFitConfig {
  int block_px = 1;          // width and height of the block that one traced pixel represents; divides the image's size
  double sigma_codes = 1.0;  // standard deviation of a block's grey level: noise, rounding and errors of the model
  int subpixels = 2;         // subpixels of the blocks' rays, as for render
  int led_samples = 3;
  std::vector<FreeParameter> parameters = {};  // free parameters in the order of parameter_names()
  std::optional<FitBalls> balls = std::nullopt;

  static SensorFitConfig read(ConfigReader& file);
};

/// All names that a parameter may have (meanings: docs/calibrate.md).
const std::vector<std::string>& parameter_names();

}  // namespace tacipc
