#include "bench/embree_rate.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "bench/machine.h"
#include "common/base/error.h"

namespace tacipc::bench {
namespace {

struct alignas(64) CameraQuery {
  alignas(32) int valid[RayPacket::kSize];
  RTCRayHit8 rays;
};
struct alignas(64) ShadowQuery {
  alignas(32) int valid[RayPacket::kSize];
  RTCRay8 rays;
};

void fill(const RayPacket& from, int* valid, RTCRay8& to) {
  std::memset(&to, 0, sizeof to);
  for (int i = 0; i < RayPacket::kSize; ++i) {
    valid[i] = (from.valid >> i & 1u) != 0 ? -1 : 0;
    to.org_x[i] = from.origin_x[i];
    to.org_y[i] = from.origin_y[i];
    to.org_z[i] = from.origin_z[i];
    to.dir_x[i] = from.direction_x[i];
    to.dir_y[i] = from.direction_y[i];
    to.dir_z[i] = from.direction_z[i];
    to.tfar[i] = from.far[i];
    to.mask[i] = ~0u;
  }
}

}  // namespace

EmbreeSeconds embree_seconds(const Positions& positions, const Triangles& triangles,
                             const std::vector<RayPacket>& camera, const std::vector<RayPacket>& shadow, int repeats) {
  const FlushDenormals flush;
  RTCDevice device = rtcNewDevice(nullptr);
  if (!device) throw DataError("Embree does not start");
  RTCScene scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices =
      static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                  3 * sizeof(float), static_cast<std::size_t>(positions.rows())));
  auto* indices =
      static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                     3 * sizeof(unsigned), static_cast<std::size_t>(triangles.rows())));
  for (Eigen::Index i = 0; i < positions.size(); ++i) vertices[i] = static_cast<float>(positions.data()[i]);
  for (Eigen::Index i = 0; i < triangles.size(); ++i) indices[i] = static_cast<unsigned>(triangles.data()[i]);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);

  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  constexpr double kUnbounded = std::numeric_limits<double>::infinity();
  EmbreeSeconds seconds{kUnbounded, kUnbounded};
  for (int repeat = 0; repeat < repeats; ++repeat) {
    std::vector<CameraQuery> first(camera.size());
    for (std::size_t i = 0; i < camera.size(); ++i) {
      fill(camera[i], first[i].valid, first[i].rays.ray);
      for (int l = 0; l < RayPacket::kSize; ++l) {
        first[i].rays.ray.tfar[l] = std::numeric_limits<float>::infinity();
        first[i].rays.hit.geomID[l] = RTC_INVALID_GEOMETRY_ID;
        first[i].rays.hit.instID[0][l] = RTC_INVALID_GEOMETRY_ID;
      }
    }
    double start = wall_s();
    for (CameraQuery& query : first) rtcIntersect8(query.valid, scene, &context, &query.rays);
    seconds.camera = std::min(seconds.camera, wall_s() - start);
    first.clear();
    std::vector<ShadowQuery> second(shadow.size());
    for (std::size_t i = 0; i < shadow.size(); ++i) fill(shadow[i], second[i].valid, second[i].rays);
    start = wall_s();
    for (ShadowQuery& query : second) rtcOccluded8(query.valid, scene, &context, &query.rays);
    seconds.shadow = std::min(seconds.shadow, wall_s() - start);
  }
  rtcReleaseScene(scene);
  rtcReleaseDevice(device);
  return seconds;
}

}  // namespace tacipc::bench
