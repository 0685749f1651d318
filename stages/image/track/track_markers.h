// Follows printed markers through a series of images.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "stages/image/track/dot_center.h"
#include "stages/image/track/track_config.h"

namespace tacipc {

/// Method that found a position: `lost` none (NaN), `flow` optical flow alone, `center` centroid of the dot.
enum class TrackQuality : std::uint8_t { lost = 0, flow = 1, center = 2 };

/// Positions of all markers in all images.
struct MarkerTracks {
  int num_markers = 0;
  std::vector<std::vector<Eigen::Vector2d>> px;         // per frame and marker; the first pixel spans 0 … 1
  std::vector<std::vector<TrackQuality>> quality = {};  // per frame and marker
  double rest_diameter_px = 0.0;                        // mean over the markers found in the first image
};

/// Finds dots in the first of `count` images and follows them. Flow from the previous image predicts the position, and
/// the centroid there is the dot. A dot counts only near the prediction and with an area near that at rest; otherwise
/// the flow's own result is kept. If flow fails, or deviates from the neighbours by half a spacing (a grid of dots
/// repeats after one spacing), the neighbours' mean displacement predicts the position; so a lost marker may be found
/// again. If two markers claim one dot, the better predicted one keeps it.
/// \param start positions of the markers in px, in that order: each is the nearest dot within half a spacing; a marker
/// without a dot stays lost. Absent: all dots are markers
/// \throw DataError if the first image shows no dots, or images differ in size
MarkerTracks track_markers(int count, const std::function<ByteImage(int)>& image, const TrackConfig& config,
                           const std::optional<std::vector<Eigen::Vector2d>>& start);

/// CSV with columns marker,frame,x_px,y_px,dx_px,dy_px,quality: all frames of the first marker, then of the next. d is
/// the displacement since the first frame; fields are empty where a marker is lost. `frames` are the numbers of the
/// images.
std::string tracks_csv(const MarkerTracks& tracks, const std::vector<int>& frames);

}  // namespace tacipc
