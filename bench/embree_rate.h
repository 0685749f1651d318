// How fast Embree itself answers given rays: the yardstick for our own way to it.
#pragma once

#include <vector>

#include "common/base/types.h"
#include "common/optics/ray_scene.h"

namespace tacipc::bench {

/// Seconds of processor and wall time (one thread) that bare loops over rtcIntersect8 and rtcOccluded8 take for the
/// packets, which are already in Embree's own form; the scene is built as RayScene builds it. Minimum of `repeats`.
struct EmbreeSeconds {
  double camera = 0.0;
  double shadow = 0.0;
};
EmbreeSeconds embree_seconds(const Positions& positions, const Triangles& triangles,
                             const std::vector<RayPacket>& camera, const std::vector<RayPacket>& shadow, int repeats);

}  // namespace tacipc::bench
