// Finds dark dots in an image without start positions.
#pragma once

#include <vector>

#include "stages/image/track/dot_center.h"
#include "stages/image/track/track_config.h"

namespace tacipc {

/// Spots darker than their surroundings, with centres (dot_center), in reading order: rows from the top, each from the
/// left. The surroundings are the morphological closing of the light by a disc wider than any dot. Pixels darker by
/// half of `least_contrast` belong to a spot. A connected spot is a dot if the disc of equal area has a diameter within
/// the bounds, the spot is at most twice as long as wide, and it does not touch the image's edge.
std::vector<DotCenter> find_dots(const FloatImage& light, const TrackConfig& config);

/// Distance from each point to its nearest neighbour, px; 10⁹ for a single point.
std::vector<double> spacings(const std::vector<Eigen::Vector2d>& points);

}  // namespace tacipc
