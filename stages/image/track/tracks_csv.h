// Tracks as a table.
#pragma once

#include <string>
#include <vector>

#include "stages/image/track/track_markers.h"

namespace tacipc {

/// marker,frame,x_px,y_px,dx_px,dy_px,quality: all frames of the first marker, then of the next. d counts from the
/// first frame; fields are empty where a marker is lost. `frames` are the numbers of the images.
std::string tracks_csv(const MarkerTracks& tracks, const std::vector<int>& frames);

}  // namespace tacipc
