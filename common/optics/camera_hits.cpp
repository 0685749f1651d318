#include "common/optics/camera_hits.h"

namespace tacipc {
namespace {

constexpr int kRays = RayPacket::kSize;
static_assert(kRays == kLanes);

/// Retries rays that met nothing with an offset of 1e-6: a ray exactly through a vertex may slip through all its
/// triangles.
void nudge(const RayScene& scene, const CameraRays& rays, std::uint32_t missed, std::array<int, kRays>& triangles,
           HitCounts& counts) {
  for (const Vector3& aside : {Vector3(1e-6, 0.0, 0.0), Vector3(0.0, 1e-6, 0.0)}) {
    RayPacket beside;
    for (int l = 0; l < kRays; ++l)
      beside.set(l, lane_of(rays.origin, l), (lane_of(rays.direction, l) + aside).normalized(), 0.0);
    beside.valid = missed;
    const auto found = scene.first_hits(beside);
    for (int l = 0; l < kRays; ++l) {
      if (found[l] < 0) continue;
      triangles[l] = found[l];
      missed &= ~(1u << l);
      ++counts.nudged;
    }
    if (missed == 0) return;
  }
}

}  // namespace

CameraHits find_hits(const RayScene& scene, const Membrane& membrane, const CameraRays& rays, int count,
                     RayPacket& packet, HitCounts& counts) {
  packet.valid = 0;
  for (int l = 0; l < kRays; ++l) {
    if (l < count && rays.transmittance[l] > 0.0) {
      packet.set(l, lane_of(rays.origin, l), lane_of(rays.direction, l), 0.0);
    } else {
      packet.set(l, Vector3::Zero(), Vector3::UnitZ(), 0.0);
      packet.valid &= ~(1u << l);
      counts.outside += l < count;
    }
  }
  auto triangles = scene.first_hits(packet);
  std::uint32_t missed = 0;
  for (int l = 0; l < kRays; ++l) {
    if ((packet.valid >> l & 1u) != 0 && triangles[l] < 0) missed |= 1u << l;
  }
  if (missed != 0) nudge(scene, rays, missed, triangles, counts);
  CameraHits out;
  for (int l = 0; l < count; ++l) {
    if ((packet.valid >> l & 1u) == 0) continue;
    const Ray ray{.origin = lane_of(rays.origin, l), .direction = lane_of(rays.direction, l)};
    const int triangle = triangles[l];
    if (triangle >= 0) {
      out.hits[l] = surface_hit(membrane, triangle, ray);
    } else if (inside_outline(membrane, ray)) {
      if (!out.fallen) out.fallen = l;
    } else {
      ++counts.outside;
    }
  }
  return out;
}

}  // namespace tacipc
