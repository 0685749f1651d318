#include "common/optics/ray_scene.h"

#include <embree3/rtcore.h>
#include <tbb/task_arena.h>

#include <cstring>
#include <limits>

#include "common/base/error.h"

namespace tacipc {

struct RayScene::Handles {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  RTCGeometry geometry = nullptr;  // owned by the scene
  float* vertices = nullptr;
  ~Handles() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
};

namespace {

void check(RTCDevice device, const char* step) {
  const RTCError error = rtcGetDeviceError(device);
  if (error != RTC_ERROR_NONE) throw DataError("Embree failed to {}: error {}", step, static_cast<int>(error));
}

}  // namespace

RayScene::RayScene(const Positions& positions, const Triangles& triangles) : handles_(std::make_unique<Handles>()) {
  Handles& h = *handles_;
  h.device = rtcNewDevice(nullptr);
  if (!h.device) check(nullptr, "start");
  h.scene = rtcNewScene(h.device);
  // Without the robust flag rays pass through shared edges: structured camera rays hit edges exactly.
  rtcSetSceneFlags(h.scene, RTC_SCENE_FLAG_ROBUST);
  h.geometry = rtcNewGeometry(h.device, RTC_GEOMETRY_TYPE_TRIANGLE);
  h.vertices =
      static_cast<float*>(rtcSetNewGeometryBuffer(h.geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                  3 * sizeof(float), static_cast<std::size_t>(positions.rows())));
  auto* indices =
      static_cast<unsigned*>(rtcSetNewGeometryBuffer(h.geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                     3 * sizeof(unsigned), static_cast<std::size_t>(triangles.rows())));
  check(h.device, "make room for the triangles");
  for (Eigen::Index i = 0; i < triangles.size(); ++i) indices[i] = static_cast<unsigned>(triangles.data()[i]);
  rtcAttachGeometry(h.scene, h.geometry);
  rtcReleaseGeometry(h.geometry);
  move(positions);
}

RayScene::~RayScene() = default;

void RayScene::move(const Positions& positions) {
  Handles& h = *handles_;
  for (Eigen::Index i = 0; i < positions.size(); ++i) h.vertices[i] = static_cast<float>(positions.data()[i]);
  rtcUpdateGeometryBuffer(h.geometry, RTC_BUFFER_TYPE_VERTEX, 0);
  rtcCommitGeometry(h.geometry);
  // One thread, so that the tree, and with it the triangle reported for a hit on an edge, is always the same.
  tbb::task_arena one_thread(1);
  one_thread.execute([&] { rtcCommitScene(h.scene); });
  check(h.device, "build the tree");
}

namespace {

constexpr std::size_t kLanesBytes = sizeof(RayPacket::Lanes);

void fill(const RayPacket& rays, RTCRay8& out, int* valid) {
  std::memcpy(out.org_x, rays.origin_x.data(), kLanesBytes);
  std::memcpy(out.org_y, rays.origin_y.data(), kLanesBytes);
  std::memcpy(out.org_z, rays.origin_z.data(), kLanesBytes);
  std::memcpy(out.dir_x, rays.direction_x.data(), kLanesBytes);
  std::memcpy(out.dir_y, rays.direction_y.data(), kLanesBytes);
  std::memcpy(out.dir_z, rays.direction_z.data(), kLanesBytes);
  for (int i = 0; i < RayPacket::kSize; ++i) {
    valid[i] = (rays.valid >> i & 1u) != 0 ? -1 : 0;
    out.tnear[i] = 0.0f;
    out.time[i] = 0.0f;
    out.mask[i] = ~0u;
    out.id[i] = 0;
    out.flags[i] = 0;
  }
}

}  // namespace

std::array<int, RayPacket::kSize> RayScene::first_hits(const RayPacket& rays) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  alignas(32) RTCRayHit8 query;
  alignas(32) int valid[RayPacket::kSize];
  fill(rays, query.ray, valid);
  for (int i = 0; i < RayPacket::kSize; ++i) {
    query.ray.tfar[i] = std::numeric_limits<float>::infinity();
    query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  rtcIntersect8(valid, handles_->scene, &context, &query);
  std::array<int, RayPacket::kSize> triangles{};
  for (int i = 0; i < RayPacket::kSize; ++i) {
    const bool hit = valid[i] != 0 && query.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
    triangles[i] = hit ? static_cast<int>(query.hit.primID[i]) : -1;
  }
  return triangles;
}

std::uint32_t RayScene::blocked(const RayPacket& rays) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  alignas(32) RTCRay8 query;
  alignas(32) int valid[RayPacket::kSize];
  fill(rays, query, valid);
  std::memcpy(query.tfar, rays.far.data(), kLanesBytes);
  rtcOccluded8(valid, handles_->scene, &context, &query);
  std::uint32_t bits = 0;
  for (int i = 0; i < RayPacket::kSize; ++i) bits |= query.tfar[i] < 0.0f ? 1u << i : 0u;
  return bits & rays.valid;
}

}  // namespace tacipc
