// Printed markers followed through a series of images.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "stages/image/track/dot_center.h"
#include "stages/image/track/track_config.h"

namespace tacipc {

/// How a place was found: `lost` not at all (NaN), `flow` by optical flow alone, `center` as the dot's centroid.
enum class TrackQuality : std::uint8_t { lost = 0, flow = 1, center = 2 };

struct MarkerTracks {
  int num_markers = 0;
  std::vector<std::vector<Eigen::Vector2d>> px;         // per frame and marker; the first pixel spans 0 … 1
  std::vector<std::vector<TrackQuality>> quality = {};  // per frame and marker
  double rest_diameter_px = 0.0;                        // mean over the markers found in the first image
};

/// Finds dots in the first of `count` images and follows them: flow from the image before says where to look, the
/// centroid there where the dot is. A dot counts only near where flow led, with an area near that at rest; otherwise
/// flow's own answer is kept. Where flow failed, or leads half a spacing away from what the neighbours do (a grid of
/// dots looks the same one spacing on), the neighbours' mean displacement says where to look; so a marker that was lost
/// may be found again. Of two markers that claim one dot the better predicted keeps it. With `start`, px, the markers
/// are those places, in that order, each the nearest dot within half a spacing of it; one without a dot stays lost.
/// \throw DataError if the first image shows no dots, or images differ in size
MarkerTracks track_markers(int count, const std::function<ByteImage(int)>& image, const TrackConfig& config,
                           const std::optional<std::vector<Eigen::Vector2d>>& start);

/// marker,frame,x_px,y_px,dx_px,dy_px,quality: all frames of the first marker, then of the next. d counts from the
/// first frame; fields are empty where a marker is lost. `frames` are the numbers of the images.
std::string tracks_csv(const MarkerTracks& tracks, const std::vector<int>& frames);

}  // namespace tacipc
