#include "stages/render/ray_scene.h"

#include <embree3/rtcore.h>
#include <pmmintrin.h>
#include <tbb/task_arena.h>
#include <xmmintrin.h>

#include <limits>

#include "common/error.h"

namespace tacipc {

struct RayScene::Handles {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
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

RayScene::RayScene(const Positions& positions, const Triangles& triangles)
    : handles_(std::make_unique<Handles>()), lowest_z_(positions.col(2).minCoeff()) {
  Handles& h = *handles_;
  h.device = rtcNewDevice(nullptr);
  if (!h.device) check(nullptr, "start");
  h.scene = rtcNewScene(h.device);
  // Without the robust flag rays fall through shared edges: structured camera rays hit edges exactly.
  rtcSetSceneFlags(h.scene, RTC_SCENE_FLAG_ROBUST);
  const RTCGeometry geometry = rtcNewGeometry(h.device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices =
      static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                  3 * sizeof(float), static_cast<std::size_t>(positions.rows())));
  auto* indices =
      static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                     3 * sizeof(unsigned), static_cast<std::size_t>(triangles.rows())));
  check(h.device, "make room for the triangles");
  for (Eigen::Index i = 0; i < positions.size(); ++i) vertices[i] = static_cast<float>(positions.data()[i]);
  for (Eigen::Index i = 0; i < triangles.size(); ++i) indices[i] = static_cast<unsigned>(triangles.data()[i]);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(h.scene, geometry);
  rtcReleaseGeometry(geometry);
  // One thread, so that the tree, and with it which of two triangles an edge hit reports, is always the same.
  tbb::task_arena one_thread(1);
  one_thread.execute([&] { rtcCommitScene(h.scene); });
  check(h.device, "build the tree");
}

RayScene::~RayScene() = default;

std::optional<int> RayScene::first_hit(const Ray& ray) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query{};
  query.ray.org_x = static_cast<float>(ray.origin.x());
  query.ray.org_y = static_cast<float>(ray.origin.y());
  query.ray.org_z = static_cast<float>(ray.origin.z());
  query.ray.dir_x = static_cast<float>(ray.direction.x());
  query.ray.dir_y = static_cast<float>(ray.direction.y());
  query.ray.dir_z = static_cast<float>(ray.direction.z());
  query.ray.tnear = 0.0f;
  query.ray.tfar = std::numeric_limits<float>::infinity();
  query.ray.mask = ~0u;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(handles_->scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return static_cast<int>(query.hit.primID);
}

std::uint32_t RayScene::blocked(const Vector3& origin, const std::array<Vector3, kPacket>& ends, int count) const {
  // Whatever lies wholly behind the surface is free: all of a flat face, which is every sensor's reference.
  bool behind = origin.z() < lowest_z_;
  for (int i = 0; i < count; ++i) behind = behind && ends[static_cast<std::size_t>(i)].z() < lowest_z_;
  if (behind) return 0;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  alignas(32) RTCRay8 packet;
  alignas(32) int valid[kPacket];
  for (int i = 0; i < kPacket; ++i) {
    const Vector3 direction = i < count ? Vector3(ends[static_cast<std::size_t>(i)] - origin) : Vector3::UnitZ();
    valid[i] = i < count ? -1 : 0;
    packet.org_x[i] = static_cast<float>(origin.x());
    packet.org_y[i] = static_cast<float>(origin.y());
    packet.org_z[i] = static_cast<float>(origin.z());
    packet.dir_x[i] = static_cast<float>(direction.x());
    packet.dir_y[i] = static_cast<float>(direction.y());
    packet.dir_z[i] = static_cast<float>(direction.z());
    packet.tnear[i] = 0.0f;
    packet.tfar[i] = 1.0f;  // the direction is the whole segment
    packet.time[i] = 0.0f;
    packet.mask[i] = ~0u;
    packet.id[i] = 0;
    packet.flags[i] = 0;
  }
  rtcOccluded8(valid, handles_->scene, &context, &packet);
  std::uint32_t bits = 0;
  for (int i = 0; i < count; ++i) bits |= packet.tfar[i] < 0.0f ? 1u << i : 0u;
  return bits;
}

FlushDenormals::FlushDenormals() : before_(_mm_getcsr()) {
  _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
  _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
}

FlushDenormals::~FlushDenormals() { _mm_setcsr(before_); }

}  // namespace tacipc
