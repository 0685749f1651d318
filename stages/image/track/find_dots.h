// Dark dots in an image, without start positions.
#pragma once

#include <vector>

#include "stages/image/track/dot_center.h"
#include "stages/image/track/track_config.h"

namespace tacipc {

/// Spots darker than what surrounds them, with centres (dot_center), in reading order: rows from the top, each from the
/// left. Surroundings are the morphological closing of the light by a disc wider than any dot; what lies half of
/// `least_contrast` below belongs to a spot, and connected spots whose disc of equal area has a diameter within the
/// bounds, at most twice as long as wide and clear of the image's edge, are dots.
std::vector<DotCenter> find_dots(const FloatImage& light, const TrackConfig& config);

/// Distance from each point to the nearest other, px; 10⁹ where there is none.
std::vector<double> spacings(const std::vector<Eigen::Vector2d>& points);

}  // namespace tacipc
