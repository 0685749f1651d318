// configs/sensors/calibrate/*.yaml
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "common/base/types.h"
#include "common/config/config.h"
#include "common/sensor/light_field.h"

namespace tacipc {

/// Where a lamp is thought to be at first: at this azimuth (from x towards y) and distance from the axis, so that its
/// light rises at atan(elevation_tan) to the front's plane.
struct LampGuess {
  double azimuth_rad = 0.0;
  double distance_m = 0.0;
  double elevation_tan = 0.0;
  double half_width_rad = 0.0;  // of a strip, in azimuth

  Vector3 position_m() const {
    return distance_m * Vector3(std::cos(azimuth_rad), std::sin(azimuth_rad), -elevation_tan);
  }
};

/// How far the construction allows lamps to be from the guess. Colours mix freely, so without bounds lamps can trade
/// places or run to infinity, and mixtures of them explain the balls about as well.
struct LampBounds {
  double azimuth_rad = 0.0;  // either way from the guess
  std::array<double, 2> elevation_tan{};
  std::array<double, 2> distance_m{};
  std::array<double, 2> half_width_rad{};  // equal: widths stay at the guess
};

struct CalibrateConfig {
  double ball_radius_m = 0.0;
  double contact_gap_m = 0.0;    // the rim one sees of a contact: where the ball has left the membrane by this
  bool fit_contact_gap = false;  // the gap is fitted too, from where the labels' rims lie on the fitted balls
  double label_sigma_px = 0.0;   // of centre and radius as labelled; 0: taken as they are
  double fit_radius_px = 0.0;    // pixels this near a ball's centre enter the fit …
  int fit_stride_px = 1;         // … every so many along x and y
  double drift_radius_px = 0.0;  // pixels farther than this determine each channel's drift since the background
  int object_margin_px = 0;      // pixels this near a known object's box enter its fit too
  std::vector<LampGuess> lamps;
  LampBounds bounds;
  bool fit_lamps = true;        // else they stay where the guess has them
  LightGeometry geometry = {};  // its lamps and its field's width come later
  double blur_px = 0.0;
  double relief_slope = 0.0;  // expected deviation of a print's slopes from its mesh; 0: reliefs are not measured
  double ridge = 0.0;         // on the weights, as a part of each feature's own square sum
  int folds = 0;              // of the cross-validation over balls

  static CalibrateConfig read(ConfigReader& in);
};

}  // namespace tacipc
