// Where camera rays meet the membrane, eight at a time, without gaps.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "common/optics/membrane.h"
#include "common/optics/ray_scene.h"
#include "common/optics/surface_hit.h"
#include "common/sensor/camera_model.h"

namespace tacipc {

struct HitCounts {
  std::int64_t nudged = 0;   // slipped through a vertex and hit after a retry with an offset of 1e-6
  std::int64_t outside = 0;  // pass beside the membrane
};

struct CameraHits {
  std::array<std::optional<SurfaceHit>, RayPacket::kSize> hits;
  std::optional<int> fallen;  // the first ray that must meet the membrane and does not, even after a retry
};

/// What the first `count` of eight rays meet. `packet` is left as it was traced. \pre FlushDenormals lives
CameraHits find_hits(const RayScene& scene, const Membrane& membrane, const CameraRays& rays, int count,
                     RayPacket& packet, HitCounts& counts);

}  // namespace tacipc
