// What counts as a marker in an image, and how far tracking may go wrong before it says so.
#pragma once

#include <string>

#include "common/config.h"

namespace tacipc {

struct TrackConfig {
  std::string curve = "srgb";       // of the codes: srgb, or linear
  double least_diameter_px = 0.0;   // of a dot at rest
  double most_diameter_px = 0.0;    // of a dot at rest
  double least_contrast = 0.3;      // of a dot: 1 − its light over that around it
  int flow_window_px = 21;          // edge of the window that flow compares
  int flow_levels = 3;              // halvings of the image, at most
  double most_return_px = 1.0;      // there and back again, flow may miss its start by this
  double most_correction_px = 3.0;  // from where flow leads to the dot's centre
  double most_area_ratio = 2.0;     // of a dot's area to that at rest, either way

  static TrackConfig read(ConfigReader& in);
};

}  // namespace tacipc
