// Distance of tracks from the known markers.
#pragma once

#include <vector>

#include "stages/image/track/track_markers.h"

namespace tacipc {

struct Agreement {
  int markers = 0;       // tracks that begin at a known marker
  int visible = 0;       // places of those that the pictures show, all frames
  int lost = 0;          // of them not found
  double mean_px = 0.0;  // distance of those found
  double max_px = 0.0;
};

/// `truth` per frame of `tracks`, px, NaN where a marker is not seen. A track belongs to the marker that is nearest to
/// where it begins, within one rest diameter.
Agreement agreement(const MarkerTracks& tracks, const std::vector<std::vector<Eigen::Vector2d>>& truth);

}  // namespace tacipc
