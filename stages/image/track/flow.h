// Pyramidal optical flow between two images.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "common/image/image.h"
#include "stages/image/track/track_config.h"

namespace tacipc {

/// Where points of one image are in the next, px: Lucas and Kanade's flow on a pyramid (Bouguet 2001, OpenCV's).
/// Nothing for a point that is not found, leaves the image, or misses its start by more than `most_return_px` on the
/// backward flow.
std::vector<std::optional<Eigen::Vector2d>> flow(const ByteImage& from, const ByteImage& to,
                                                 const std::vector<Eigen::Vector2d>& points, double spacing_px,
                                                 const TrackConfig& config);

}  // namespace tacipc
