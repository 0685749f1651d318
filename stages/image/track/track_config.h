// Criteria for a marker in an image, and limits of tracking.
#pragma once

#include <string>

#include "common/config/config.h"

namespace tacipc {

/// Configuration of track.
struct TrackConfig {
  std::string curve = "srgb";       // response curve of the images: srgb or linear
  double least_diameter_px = 0.0;   // least diameter of a dot at rest
  double most_diameter_px = 0.0;    // largest diameter of a dot at rest
  double least_contrast = 0.3;      // least contrast of a dot: 1 − its light over that around it
  int flow_window_px = 21;          // edge of the window that flow compares
  int flow_levels = 3;              // largest number of times the image is halved
  double most_return_px = 1.0;      // largest error of the backward flow at its start
  double most_correction_px = 3.0;  // largest distance between the flow's result and the dot's centre
  double most_area_ratio = 2.0;     // largest ratio between a dot's area and that at rest, or its inverse

  static TrackConfig read(ConfigReader& in);
};

}  // namespace tacipc
