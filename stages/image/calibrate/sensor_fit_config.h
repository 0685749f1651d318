// Section `sensor_fit` of a calibrate configuration.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "common/config/config.h"

namespace tacipc {

/// A value of the sensor file that is free, and what is known of it before the fit: mean ± sigma, within bounds. Units
/// are those that its name says.
struct FreeParameter {
  std::string name;
  double sigma = 0.0;
  std::optional<double> mean = std::nullopt;                   // absent: what the file says
  std::optional<std::array<double, 2>> bounds = std::nullopt;  // absent: mean ± 4 sigma, or as far as sensors are valid
};

/// Photographs of a ball pressed to contacts that are labelled.
struct FitBalls {
  double radius_m = 0.0;
  double contact_gap_m = 0.0;   // labels show where ball and membrane are this far apart
  double label_sigma_px = 0.0;  // of centre and radius; 0: labels are exact
  // Blocks whose middle is this near a label's centre count; absent: twice the largest radius of a label.
  std::optional<double> fit_radius_px = std::nullopt;
};

struct SensorFitConfig {
  int block_px = 1;          // a traced pixel stands for a block this wide and high; divides the image's size
  double sigma_codes = 1.0;  // how far a block's code may be off: noise, rounding and what the model does not know
  int subpixels = 2;         // of the blocks' rays, as render's
  int led_samples = 3;
  std::vector<FreeParameter> parameters = {};  // in the order of parameter_names()
  std::optional<FitBalls> balls = std::nullopt;

  static SensorFitConfig read(ConfigReader& file);
};

/// All names a parameter may have (docs/calibrate.md says what each of them is).
const std::vector<std::string>& parameter_names();

}  // namespace tacipc
