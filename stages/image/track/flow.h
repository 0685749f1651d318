// Pyramidal optical flow between two images.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "common/image/image.h"
#include "stages/image/track/track_config.h"

namespace tacipc {

/// Positions of points of one image in the next, px, by Lucas and Kanade's flow on a pyramid (Bouguet 2001, OpenCV).
/// \return nothing for a point that is not found, leaves the image, or returns more than `most_return_px` away from its
/// start by the backward flow
std::vector<std::optional<Eigen::Vector2d>> flow(const ByteImage& from, const ByteImage& to,
                                                 const std::vector<Eigen::Vector2d>& points, double spacing_px,
                                                 const TrackConfig& config);

}  // namespace tacipc
