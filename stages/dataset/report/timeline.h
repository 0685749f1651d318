// What the gels of a grasp or a scene share on a page: the phases over time, and their images in rows.
#pragma once

#include <string>
#include <vector>

#include "common/image/image.h"
#include "common/sample/scene_folder.h"
#include "stages/dataset/report/chart.h"

namespace tacipc {

/// A frame.
struct Instant {
  double time_s = 0.0;
  std::string phase;
};

/// A chart without curves whose shaded stretches are the phases.
Chart over_time(const std::vector<Instant>& frames, const std::string& what);

/// A row of images for each gel, of at most ten of the frames that were rendered, from the first to the last, with
/// words what they are. \throw DataError if there are none, or a gel lacks one that the first gel has
ByteImage picture_strip(const std::vector<SceneGel>& gels, const std::vector<Instant>& frames);

}  // namespace tacipc
