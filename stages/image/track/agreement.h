// Compares tracks with the known markers.
#pragma once

#include <vector>

#include "stages/image/track/track_markers.h"

namespace tacipc {

/// Statistics of the comparison.
struct Agreement {
  int markers = 0;       // tracks that begin at a known marker
  int visible = 0;       // marker positions visible in the pictures, all frames
  int lost = 0;          // visible positions that were not found
  double mean_px = 0.0;  // distance of the positions that were found
  double max_px = 0.0;
};

/// Compares tracks with `truth`, positions in px per frame of `tracks`, NaN where a marker is not visible. A track
/// belongs to the marker that is nearest to its beginning, within one rest diameter.
Agreement agreement(const MarkerTracks& tracks, const std::vector<std::vector<Eigen::Vector2d>>& truth);

}  // namespace tacipc
