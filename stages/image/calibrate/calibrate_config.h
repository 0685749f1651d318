// Content of configs/sensors/calibrate/*.yaml.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "common/base/types.h"
#include "common/config/config.h"
#include "common/sensor/light_field.h"

namespace tacipc {

/// Initial guess of a light source: at this azimuth (from x towards y) and distance from the axis, such that its light
/// rises at atan(elevation_tan) to the front's plane.
struct LampGuess {
  double azimuth_rad = 0.0;
  double distance_m = 0.0;
  double elevation_tan = 0.0;
  double half_width_rad = 0.0;  // half width of a strip in azimuth

  Vector3 position_m() const {
    return distance_m * Vector3(std::cos(azimuth_rad), std::sin(azimuth_rad), -elevation_tan);
  }
};

/// Limits of the light sources around the guess, set by the sensor's construction. Colours mix freely: without bounds,
/// sources can swap positions or run to infinity, and their mixtures explain the balls about as well.
struct LampBounds {
  double azimuth_rad = 0.0;  // largest deviation from the guess to either side
  std::array<double, 2> elevation_tan{};
  std::array<double, 2> distance_m{};
  std::array<double, 2> half_width_rad{};  // equal values: widths stay at the guess
};

/// Configuration of a fit of light to balls.
struct CalibrateConfig {
  double ball_radius_m = 0.0;
  double contact_gap_m = 0.0;    // gap between ball and membrane at the visible rim of a contact
  bool fit_contact_gap = false;  // also fit the gap, from the positions of the labels' rims on the fitted balls
  double label_sigma_px = 0.0;   // standard deviation of a label's centre and radius; 0: labels are exact
  double fit_radius_px = 0.0;    // pixels this near to a ball's centre enter the fit
  int fit_stride_px = 1;         // stride of these pixels along x and y
  double drift_radius_px = 0.0;  // pixels farther than this determine each channel's drift since the background
  int object_margin_px = 0;      // pixels this near to a known object's box also enter its fit
  std::vector<LampGuess> lamps;
  LampBounds bounds;
  bool fit_lamps = true;        // false: the light sources stay at the guess
  LightGeometry geometry = {};  // geometry; the light sources and the field's width are set later
  double blur_px = 0.0;
  double relief_slope = 0.0;  // expected deviation of a print's slopes from its mesh; 0: reliefs are not measured
  double ridge = 0.0;         // ridge on the weights, as a fraction of each feature's own square sum
  int folds = 0;              // folds of the cross-validation over balls

  static CalibrateConfig read(ConfigReader& in);
};

}  // namespace tacipc
