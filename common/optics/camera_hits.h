// Intersects camera rays with the membrane, eight at a time, without gaps between triangles.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "common/optics/membrane.h"
#include "common/optics/ray_scene.h"
#include "common/optics/surface_hit.h"
#include "common/sensor/camera_model.h"

namespace tacipc {

/// Counts of special rays.
struct HitCounts {
  std::int64_t nudged = 0;   // rays that slipped through a vertex and hit after a retry with an offset of 1e-6
  std::int64_t outside = 0;  // rays that pass next to the membrane
};

/// Result of find_hits().
struct CameraHits {
  std::array<std::optional<SurfaceHit>, RayPacket::kSize> hits;
  std::optional<int> fallen;  // first ray that must meet the membrane but does not, even after a retry
};

/// Intersects the first `count` of eight rays with the membrane.
/// \param packet on return, the rays as they were traced
/// \pre a FlushDenormals object lives on this thread
CameraHits find_hits(const RayScene& scene, const Membrane& membrane, const CameraRays& rays, int count,
                     RayPacket& packet, HitCounts& counts);

}  // namespace tacipc
