// Section `markers` of a configuration: how markers move, without a gel.
#pragma once

#include "common/base/types.h"
#include "common/config/config.h"

namespace tacipc {

/// FOTS [Zhao2024]: every motion of the object moves markers by a Gaussian of their distance.
struct FotsMotion {
  double press_per_m2 = 0.0;  // λ_d
  double shear_per_m2 = 0.0;  // λ_s
  double twist_per_m2 = 0.0;  // λ_t
  /// Its own markers: those in contact push the others.
  Eigen::Vector2d first_px = Eigen::Vector2d::Zero(), pitch_px = Eigen::Vector2d::Zero();
  int columns = 0, rows = 0;
};

struct MarkerMotionConfig {
  enum class Model { fots, superposition };
  Model model = Model::fots;
  FotsMotion fots;

  static MarkerMotionConfig read(ConfigReader& in);
};

}  // namespace tacipc
