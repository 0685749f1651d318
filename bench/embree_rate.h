// Rate at which Embree itself traces given rays, as the yardstick for RayScene.
#pragma once

#include <vector>

#include "common/base/types.h"
#include "common/optics/ray_scene.h"

namespace tacipc::bench {

/// Seconds (processor and wall time, one thread) of bare loops over rtcIntersect8 and rtcOccluded8 for packets that are
/// already in Embree's own form. The scene is built as RayScene builds it. Times are the minimum of `repeats`.
struct EmbreeSeconds {
  double camera = 0.0;
  double shadow = 0.0;
};
/// Measures both loops.
/// \pre repeats > 0
EmbreeSeconds embree_seconds(const Positions& positions, const Triangles& triangles,
                             const std::vector<RayPacket>& camera, const std::vector<RayPacket>& shadow, int repeats);

}  // namespace tacipc::bench
