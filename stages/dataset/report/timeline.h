// Common parts of the pages of a grasp or a scene: the phases over time, and rows of images of the gels.
#pragma once

#include <string>
#include <vector>

#include "common/image/image.h"
#include "common/sample/scene_folder.h"
#include "stages/dataset/report/chart.h"

namespace tacipc {

/// Time and phase of a frame.
struct Instant {
  double time_s = 0.0;
  std::string phase;
};

/// Chart without curves, in which the phases are shaded intervals.
Chart over_time(const std::vector<Instant>& frames, const std::string& what);

/// Picture with a row of images for each gel, of at most ten rendered frames from the first to the last, with labels.
/// \throw DataError if there are none, or a gel lacks one that the first gel has
ByteImage picture_strip(const std::vector<SceneGel>& gels, const std::vector<Instant>& frames);

}  // namespace tacipc
